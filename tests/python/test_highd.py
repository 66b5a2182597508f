# SPDX-License-Identifier: Apache-2.0
"""highD's tables, made here by the rules of its format: boxes by their upper left corner, image coordinates, 0 for a
vehicle that is not there. Two vehicles at constant speeds, in both driving directions, have closed forms."""

import importlib.util
import math
import unittest

import numpy as np
import rodeira

HAS_EXTENSION = bool(importlib.util.find_spec("_rodeira") or importlib.util.find_spec("rodeira._rodeira"))
needs_extension = unittest.skipUnless(HAS_EXTENSION, "the Python extension module _rodeira is not installed")
RATE_HZ, COUNT = 25.0, 500
OWN, LEADER, LAG = 7, 8, 9
OWN_MPS, LEADER_MPS, LAG_MPS = 30.0, 25.0, 38.0
LENGTH, LEADER_LENGTH, LAG_LENGTH, WIDTH = 4.5, 12.0, 5.0, 1.9
GAP_M, LAG_GAP_M = 110.0, 170.0
MARKINGS = (8.0, 11.5, 15.25)
COLUMNS = ("frame", "id", "x", "y", "width", "height", "xVelocity", "yVelocity", "dhw", "thw", "ttc",
           "precedingXVelocity", "precedingId", "followingId", "leftPrecedingId", "leftAlongsideId", "leftFollowingId",
           "rightPrecedingId", "rightAlongsideId", "rightFollowingId", "laneId")


def tracks(direction, offset_m=0.3):
    """Frames 11 to 510: the own vehicle closes in on a lorry, and from frame 400 on none is ahead; in the lane to its
    left a faster car comes. direction: 1 to the right of the image. offset_m: to the left of the lane's middle."""
    rows = {name: [] for name in COLUMNS}
    left_is_up = direction > 0  # the image's y points down
    own_lane, left_lane = ((2, 1) if left_is_up else (1, 2))
    for k in range(COUNT):
        t, frame = k / RATE_HZ, k + 11
        rear = OWN_MPS * t  # along the driving direction
        leads = frame < 400
        lag_gap = LAG_GAP_M - (LAG_MPS - OWN_MPS) * t
        gap = GAP_M - (OWN_MPS - LEADER_MPS) * t
        boxes = {OWN: (rear, LENGTH, OWN_MPS, own_lane),
                 LAG: (rear - lag_gap - LAG_LENGTH, LAG_LENGTH, LAG_MPS, left_lane)}
        if leads:
            boxes[LEADER] = (rear + LENGTH + gap, LEADER_LENGTH, LEADER_MPS, own_lane)
        for vehicle, (low, length, speed, lane) in boxes.items():
            middle = 0.5 * (MARKINGS[lane - 1] + MARKINGS[lane]) - direction * offset_m
            row = dict.fromkeys(COLUMNS, 0.0)
            row |= {"frame": frame, "id": vehicle, "x": low if direction > 0 else -low - length,
                    "y": middle - 0.5 * WIDTH, "width": length, "height": WIDTH, "xVelocity": direction * speed,
                    "laneId": lane + 1}
            if vehicle == OWN:
                row["leftFollowingId"] = LAG
                if leads:
                    row |= {"precedingId": LEADER, "dhw": gap, "precedingXVelocity": direction * LEADER_MPS,
                            "thw": gap / OWN_MPS, "ttc": gap / (OWN_MPS - LEADER_MPS)}
            for name in COLUMNS:
                rows[name].append(row[name])
    return {name: np.array(values) for name, values in rows.items()}


class Tables(unittest.TestCase):
    def test_signs_and_gaps_of_both_directions(self):
        time = np.arange(COUNT) / RATE_HZ
        for direction in (1, -1):
            with self.subTest(direction=direction):
                columns, size = rodeira.highd(tracks(direction), OWN, markings=MARKINGS)
                self.assertEqual(size, {"length_m": LENGTH, "front_m": LENGTH / 2, "width_m": WIDTH})
                np.testing.assert_allclose(columns["time_s"], time, atol=1e-12)
                np.testing.assert_allclose(columns["speed_mps"], OWN_MPS)
                np.testing.assert_allclose(columns["x_m"], direction * (OWN_MPS * time + LENGTH / 2))
                np.testing.assert_allclose(columns["heading_error_rad"], 0.0, atol=1e-12)
                np.testing.assert_allclose(columns["lane_position_m"], 0.3, atol=1e-9)
                leads = np.arange(COUNT) + 11 < 400
                gap = np.where(leads, GAP_M - (OWN_MPS - LEADER_MPS) * time, np.nan)
                np.testing.assert_allclose(columns["leader_gap_m"], gap)
                np.testing.assert_allclose(columns["leader_speed_mps"], np.where(leads, LEADER_MPS, np.nan))
                np.testing.assert_allclose(columns["leader_length_m"], np.where(leads, LEADER_LENGTH, np.nan))
                np.testing.assert_allclose(columns["left_follower_gap_m"], LAG_GAP_M - (LAG_MPS - OWN_MPS) * time)
                np.testing.assert_allclose(columns["left_follower_speed_mps"], LAG_MPS)
                self.assertTrue(np.isnan(columns["follower_gap_m"]).all())

    def test_a_vehicle_beside_is_nearer_than_the_one_behind(self):
        table = tracks(1)
        beside = 12
        own = table["id"] == OWN
        rows = {name: np.append(values, values[own]) for name, values in table.items()}
        rows["id"][-own.sum():] = beside
        rows["x"][-own.sum():] -= 2.0
        rows["leftAlongsideId"][rows["id"] == OWN] = beside
        columns, _ = rodeira.highd(rows, OWN)
        np.testing.assert_allclose(columns["left_follower_gap_m"], 2.0 - LENGTH)

    def test_wrong_tables_are_refused(self):
        table = tracks(1)
        for words, sentence in (((table,), "3 vehicles"), ((table, 77), "no vehicle 77; its ids go from 7 to 9"),
                                (({**table, "xVelocity": 0.0 * table["x"]}, OWN), "does not move"),
                                (({"xVelocty" if n == "xVelocity" else n: v for n, v in table.items()}, OWN),
                                 "did you mean 'xVelocty'")):
            with self.assertRaises(rodeira.Error) as raised:
                rodeira.highd(*words)
            self.assertIn(sentence, str(raised.exception))


@needs_extension
class MeasuresOfHighD(unittest.TestCase):
    # The least values that highD has in XX_tracksMeta.csv; where its columns say 0 there is none.
    def test_least_values_are_those_of_the_tables(self):
        for direction in (1, -1):
            with self.subTest(direction=direction):
                table = tracks(direction)
                columns, size = rodeira.highd(table, OWN, markings=";".join(map(str, MARKINGS)))
                far = {name: {"max_time_gap_s": 10} for name in ("minDHW", "minTHW", "minTTC", "leader_share")}
                names = ["minDHW", "minTHW", "minTTC", "leader_share", "maxXVelocity", "meanXVelocity",
                         "numLaneChanges", "traveledDistance", "sdlp_m"]
                got = rodeira.measures(columns, names, options=far, **size)
                own = table["id"] == OWN
                for name, column in (("gap_min_m", "dhw"), ("time_gap_min_s", "thw"), ("ttc_min_s", "ttc")):
                    values = table[column][own]
                    self.assertAlmostEqual(got[name][0], values[values > 0].min(), delta=1e-9, msg=name)
                self.assertAlmostEqual(got["leader_share"][0], 389 / COUNT, delta=1e-12)
                self.assertAlmostEqual(got["speed_max_mps"][0], OWN_MPS, delta=1e-12)
                self.assertAlmostEqual(got["distance_m"][0], OWN_MPS * (COUNT - 1) / RATE_HZ, delta=1e-6)
                self.assertEqual(got["lane_changes_n"][0], 0.0)
                self.assertAlmostEqual(got["sdlp_m"][0], 0.0, delta=1e-9)
                self.assertNotIn("minTTC", got.names)

    def test_a_table_with_highds_names_alone_says_what_to_do(self):
        with self.assertRaises(rodeira.Error) as raised:
            rodeira.measures(tracks(1), ["minTTC"], time="frame")
        self.assertIn("rodeira.highd(", str(raised.exception))

    def test_a_lag_of_a_lane_change(self):
        """The own vehicle changes to the left between 6 s and 11 s; the car behind is 8 m/s faster."""
        for direction in (1, -1):
            table = tracks(direction)
            own = table["id"] == OWN
            done = np.clip((np.arange(COUNT) / RATE_HZ - 6.0) / 5.0, 0.0, 1.0)
            across = 0.5 * (MARKINGS[2] - MARKINGS[0]) * 0.5 * (1.0 - np.cos(math.pi * done))
            table["y"][own] -= direction * across
            over = direction * (table["y"][own] + WIDTH / 2 - MARKINGS[1]) < 0
            table["followingId"][np.flatnonzero(own)[over]] = LAG
            table["leftFollowingId"][np.flatnonzero(own)[over]] = 0
            columns, size = rodeira.highd(table, OWN, markings=MARKINGS)
            got = rodeira.measures(columns, ["lane_changes_n", "lane_change_severity_s", "lane_change_urgency_s"],
                                   **size)
            self.assertEqual(got["lane_changes_n"][0], 1.0)
            # The lateral speed is below 0.1 m/s for the last 0.14 s.
            self.assertAlmostEqual(got["lane_change_severity_s"][0], LAG_GAP_M / 8.0 - 10.86, delta=0.06)
            self.assertAlmostEqual(got["lane_change_urgency_s"][0], GAP_M / 5.0 - 6.14, delta=0.06)


if __name__ == "__main__":
    unittest.main()
