# SPDX-License-Identifier: Apache-2.0
"""Episodes that an agent drives (`rodeira.Env`). Oracles: the program's own verification, a scripted run of the same
controls, and episodes that are driven twice. RODEIRA names the program; without it all is skipped."""

import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rodeira
from rodeira.decode import Decoder
from rodeira.layout import Layouts
from rodeira.nodes import Ragged, finished

ROOT = pathlib.Path(__file__).parents[2]
PROGRAM = os.environ.get("RODEIRA", "")
DEMO = ROOT / "launch/demo.yaml"  # N-222 with 20 cars, a node each millisecond
OFF_THE_ROAD = [0.05, 1, 0]       # in the demo: to a house beside it
LAUNCH = """rodeira: launch/1
world: {root}/configs/worlds/plane.yaml
seed: 1
nodes:
  road: {{kind: road}}
  pilot: {{kind: input, config: {{source: {source}}}}}
  ego: {{kind: vehicle, config: {{vehicle: {root}/configs/vehicles/default.yaml}}}}
"""


def actions(number, count=40):
    random = np.random.default_rng(number)
    return [random.uniform([-0.5, 0.0, 0.0], [0.5, 1.0, 0.2]) for _ in range(count)]


def drive(env, episode):
    """The digest behind the last action."""
    for action in episode:
        env.step(action)
    return env.digest


def run(*words, status=0):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == status, done.stderr
    return done.stdout


@unittest.skipUnless(PROGRAM, "RODEIRA does not name the program")
class EnvTest(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)

    def env(self, launch=DEMO, *words, **options):
        env = rodeira.Env(launch, *words, **options)
        self.addCleanup(env.close)
        return env

    def alone(self, source="agent"):
        """A launch file with a car on a plane, and no recorder."""
        path = self.folder / "alone.yaml"
        path.write_text(LAUNCH.format(root=ROOT, source=source))
        return path


class Episodes(EnvTest):
    def test_seed_and_actions_make_the_episode(self):
        env = self.env()
        first, info = env.reset(seed=3)
        self.assertEqual(info, {"time_s": 0.0, "step": 0, "seed": 3})
        digest = drive(env, actions(1))
        self.assertEqual(env.now.step, 400)
        again, _ = env.reset()
        for name in first.topics:
            self.assertEqual(again.payload(name), first.payload(name), name)
        self.assertEqual(drive(env, actions(1)), digest)
        env.reset()
        self.assertNotEqual(drive(env, actions(2)), digest)
        other, _ = env.reset(seed=4)
        self.assertNotEqual(other.payload("traffic_state"), first.payload("traffic_state"))
        self.assertNotEqual(drive(env, actions(1)), digest)
        env.reset(seed=3)
        self.assertEqual(drive(env, actions(1)), digest)
        fresh = self.env()
        fresh.reset(seed=3)
        self.assertEqual(drive(fresh, actions(1)), digest)

    def test_a_crash_is_forgotten(self):
        env, fresh = self.env(), self.env()
        digests = []
        for _ in range(2):
            env.reset()
            while not env.now["collisions"]["contacts"]:
                env.step(OFF_THE_ROAD)
            digests.append(drive(env, actions(1)))
        fresh.reset()
        while not fresh.now["collisions"]["contacts"]:
            fresh.step(OFF_THE_ROAD)
        self.assertEqual([*digests, drive(fresh, actions(1))], digests[:1] * 3)

    def test_a_scenario_with_rain_begins_again_too(self):
        for launch in ("car_ahead", "rain", "lights"):
            env = self.env(ROOT / f"launch/{launch}.yaml")
            env.reset()
            digests = {drive(env, actions(5, 150))}
            env.reset()
            digests.add(drive(env, actions(5, 150)))
            fresh = self.env(ROOT / f"launch/{launch}.yaml")
            fresh.reset()
            digests.add(drive(fresh, actions(5, 150)))
            self.assertEqual(len(digests), 1, launch)

    def test_a_recorded_episode_verifies_and_branches(self):
        env, path, branch = self.env(), self.folder / "drive.mcap", self.folder / "branch.mcap"
        env.reset(seed=2)
        digest = drive(env, actions(1, 150))
        env.reset(seed=2, record=path)
        self.assertEqual(drive(env, actions(1, 150)), digest)
        env.reset()
        self.assertIn("identical: 1500 steps", run("replay", path, "--verify"))
        configs = ROOT / "configs"
        run("replay", path, "--branch", f"nodes.driver.config={{source: autopilot, driver: {configs}/drivers/"
            f"default.yaml, vehicle: {configs}/vehicles/default.yaml}}", "--from", "1", "--record", branch)
        self.assertIn("identical: 500 steps", run("replay", branch, "--verify"))

        recorded = rodeira.open(path)["controls"]
        names = ("steering_wheel_rad", "throttle", "brake")
        table = np.column_stack([recorded[name] for name in names])
        self.assertEqual(len(table), 151)  # the first is before any action
        np.testing.assert_array_equal(table[1:], actions(1, 150))
        self.assertEqual(drive(env, table[1:]), digest)

    def test_nodes_of_ones_own_take_part_as_shared_objects(self):
        built = pathlib.Path(PROGRAM).parent
        for name in ("eye-tracker", "gaze-monitor"):
            for suffix in ("", ".so"):
                made = built / f"rodeira-test-{name}{suffix}"
                self.assertTrue(made.exists(), made)
                (self.folder / (name.replace("-", "_") + suffix)).symlink_to(made)
        example = ROOT / "examples/own_node"
        for name in ("eye.yaml", "monitor.yaml", "gaze.idl"):
            (self.folder / name).write_text((example / name).read_text())
        text = (example / "own_node.yaml.in").read_text().replace("@RODEIRA_DATA@", str(ROOT))
        text = re.sub(r"config: \{source: script.*\}\}", "config: {source: agent}}", text)
        launch, without = self.folder / "own.yaml", self.folder / "without.yaml"
        launch.write_text(text)
        without.write_text(text.replace("library: eye_tracker.so", ""))
        env = self.env(launch)
        observation, _ = env.reset()
        self.assertIn("lab/gaze", observation.topics)
        digests = []
        for _ in range(3):
            env.reset()
            digests.append(drive(env, actions(1)))
        env.reset(seed=9)
        env.reset(seed=1)
        digests.append(drive(env, actions(1)))
        fresh = self.env(launch)
        fresh.reset()
        self.assertEqual({*digests, drive(fresh, actions(1))}, {digests[0]})
        with self.assertRaisesRegex(rodeira.Error, "node 'eye': its program .* needs its shared object, as 'library'"):
            self.env(without).reset()

    def test_it_drives_as_a_script_with_the_same_controls(self):
        script, scripted, path = (self.folder / name for name in ("drive.csv", "scripted.mcap", "env.mcap"))
        script.write_text("time_s,steering_wheel_rad,throttle\n0,0,0\n0.01,0.2,0.7\n")
        run("run", self.alone(f"script, script: {script}"), "--in-process", "--for", "2", "--record", scripted)
        with self.env(self.alone(), "pilot", controls=["throttle", "steering_wheel_rad"]) as env:
            env.reset(record=path)
            drive(env, [[0.7, 0.2]] * 200)
        one, other = rodeira.open(scripted)["vehicle_state"].array(), rodeira.open(path)["vehicle_state"].array()
        self.assertEqual(len(one), 2001)
        self.assertGreater(other["odometer_m"][-1], 1.0)
        self.assertEqual(one.tobytes(), other.tobytes())

    def test_the_functions_of_the_user_see_the_samples(self):
        env = self.env(observation=lambda now: now["ego.vehicle_state"]["odometer_m"],
                       reward=lambda now, action: now.time_s + action[1], terminated=lambda now: now.time_s > 0.035,
                       for_s=0.02)
        start, _ = env.reset()
        self.assertEqual(start, 0.0)
        self.assertEqual(env.step([0, 0.5, 0])[1:4], (0.51, False, False))
        _, _, terminated, truncated, info = env.step([0, 0.5, 0])
        self.assertEqual((terminated, truncated, info["time_s"]), (False, True, 0.02))
        self.assertEqual(len(env.now.all("collisions")), 10)
        self.assertEqual([one["header"]["step"] for one in env.now.all("collisions")], list(range(11, 21)))
        self.assertEqual(env.now["vehicle_state"]["header"]["step"], 20)
        self.assertEqual(len(env.now["traffic_state"]["agents"]["speed_mps"]), 20)
        self.assertIn("traffic_state", env.now)
        self.assertNotIn("weather_state", env.now)
        self.assertTrue(env.action_space.contains(env.action_space.sample()))
        self.assertFalse(env.action_space.contains([0, 2, 0]))

    def test_samples_are_those_that_the_reader_of_recordings_decodes(self):
        def compare(one, node, path):
            if isinstance(one, dict):
                for name in one:
                    compare(one[name], node[name], f"{path}.{name}")
            elif isinstance(one, list):  # of structures with texts: the reader has a column a member
                for i, element in enumerate(one):
                    for name in element:
                        self.assertEqual(element[name], finished(node.values[name])[i], f"{path}.{name}")
                self.assertEqual(len(node), 1)
                self.assertEqual(node.offsets[-1], len(one))
            else:
                np.testing.assert_array_equal(one, finished(node)[0] if isinstance(node, Ragged) else node[0], path)

        env = self.env()
        env.reset()
        while not env.now["collisions"]["contacts"]:
            env.step(OFF_THE_ROAD)
        self.assertTrue(env.now["collisions"]["contacts"][0]["partner_name"].startswith("n222-object"))
        layouts = Layouts()
        for name in ("vehicle_state", "collisions", "traffic_state", "traffic_details", "signals_state"):
            sample, payload = env.now[name], env.now.payload(name)
            kind = env._topics._decoders[env._topics.number(name)].kind
            compare(sample, Decoder(kind, layouts).decode(payload, np.zeros(1, int), np.full(1, len(payload))), name)

    def test_a_thousand_resets_need_no_more_memory_and_files(self):
        def held():
            process = env._process._process.pid
            status = pathlib.Path(f"/proc/{process}/status").read_text()
            rss_kib = int(status.split("VmRSS:")[1].split()[0])
            children = pathlib.Path(f"/proc/{process}/task/{process}/children").read_text().split()
            files = [len(os.listdir(f"/proc/{one}/fd")) for one in (process, "self")]
            return rss_kib, (children, files, len(os.listdir(self.folder)))

        self.addCleanup(setattr, tempfile, "tempdir", tempfile.tempdir)
        tempfile.tempdir = str(self.folder)
        os.environ["TMPDIR"], before = str(self.folder), os.environ.get("TMPDIR")
        self.addCleanup(lambda: os.environ.pop("TMPDIR") if before is None else os.environ.update(TMPDIR=before))
        env = self.env()
        for _ in range(100):
            env.reset()
            env.step([0, 0.1, 0])
        for seed in range(3):
            env.reset(seed=seed)
        rss_kib, others = held()
        for _ in range(1000):
            env.reset()
            env.step([0, 0.1, 0])
        for seed in range(10):
            env.reset(seed=seed)
        more_kib, more_others = held()
        self.assertEqual(more_others, others)
        self.assertLess(more_kib - rss_kib, 4096)

    def test_several_at_once(self):
        envs = [self.env() for _ in range(3)]
        for seed, env in enumerate(envs):
            env.reset(seed=seed % 2)
        for action in actions(1):
            for env in envs:
                env.step(action)
        self.assertEqual(envs[0].digest, envs[2].digest)
        self.assertNotEqual(envs[0].digest, envs[1].digest)

    def test_the_page_keeps_its_lane(self):
        page = (ROOT / "docs/how-to/agent.md").read_text()
        script = self.folder / "agent.py"
        seeds = 3 if "RODEIRA_LONG_TESTS" in os.environ else 1
        text = re.search(r"^```python\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)[1]
        self.assertIn("in range(3):", text)
        script.write_text(text.replace("in range(3):", f"in range({seeds}):"))
        done = subprocess.run([sys.executable, script], cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=240, env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(re.findall(r"seed (\d): ([\d.]+) s", done.stdout), [(str(i), "30.00") for i in range(seeds)])
        self.assertEqual(len(list(self.folder.glob("agent-*.mcap"))), seeds)


class Refusals(EnvTest):
    def refused(self, pattern, call, *words, **options):
        with self.assertRaisesRegex(rodeira.Error, pattern):
            call(*words, **options)

    def refused_by_rodeira(self, name, place, call, *words, **options):
        """Its error has that id, and names the place."""
        with self.assertRaises(rodeira.Error) as caught:
            call(*words, **options)
        self.assertEqual(caught.exception.id, name)
        self.assertIn(place, str(caught.exception))

    def test_launch_files_and_agents(self):
        for name, place, words, changes in (("file.not_found", "nothing.yaml", ["nothing.yaml"], {}),
                                            ("launch.no_agent_node", "'driver'", [DEMO, "drver"], {}),
                                            ("launch.no_agent_node", "'vehicle'", [DEMO, "ego"], {}),
                                            ("file.not_found", "nowhere.yaml", [DEMO], {"world": "nowhere.yaml"}),
                                            ("config.unknown_key", "'sed'", [DEMO], {"sed": 1})):
            self.refused_by_rodeira(name, place, rodeira.Env, *words, set=changes)
        for name, place, changes in (("config.wrong_type", "vehicles", {"nodes.traffic.config.vehicles": "many"}),
                                     ("launch.no_road_server", "'ego'", {"nodes.road.kind": "none"})):
            self.refused_by_rodeira(name, place, self.env(set=changes).reset)
        self.refused("unknown control 'throtle'; did you mean 'throttle'", rodeira.Env, DEMO, controls=["throtle"])
        self.refused("a name stands twice", rodeira.Env, DEMO, controls=["brake", "brake"])
        self.refused("a list of names was expected", rodeira.Env, DEMO, controls="brake")
        done = subprocess.run([PROGRAM, "run", self.alone(), "--in-process", "--no-record"], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("rodeira.Env", done.stderr)

    def test_actions(self):
        env = self.env(self.alone(), "pilot", controls=["throttle", "gear"])
        self.refused("reset\\(\\) was expected", env.step, [0, 1])
        env.reset()
        digest = env.digest
        for action, pattern in ((0.5, r"shape \(\)"), ([0.5], r"shape \(1,\)"), ([[0.5, 1]], r"shape \(1, 2\)"),
                                ([0.5, 1, 0], r"\(2,\) was expected: throttle, gear"),
                                ("full", "numbers were expected"),
                                ([math.nan, 1], "throttle is nan"), ([math.inf, 1], "throttle is inf"),
                                ([1.1, 1], "throttle is 1.1; a number from 0 to 1"),
                                ([0.5, 1.5], "gear is 1.5; a whole number from -1 to 20"),
                                ({"throttel": 1}, "did you mean 'throttle'"), ({"brake": 1}, "unknown control 'brake'"),
                                ({"throttle": "x"}, "throttle is 'x'"), (None, "throttle")):
            self.refused(pattern, env.step, action)
        self.assertEqual(env.digest, digest)
        env.step({"throttle": 1})
        env.step({"throttle": np.float32(0.5), "gear": np.int64(-1)})

    def test_resets_and_ends(self):
        env = self.env(self.alone(), "pilot", terminated=lambda now: now.time_s > 0.005)
        self.refused("reset\\(\\) was expected", lambda: env.now)
        for seed in (-1, 1.5, True, "one", 2**63):
            self.refused("seed is", env.reset, seed=seed)
        self.refused("unknown option 'recrd'; did you mean 'record'", env.reset, options={"recrd": 1})
        there = self.folder / "there.mcap"
        there.write_text("mine")
        self.refused_by_rodeira("file.exists", "there.mcap", env.reset, record=there)
        self.refused("reset\\(\\) was expected", env.step, [0, 0, 0])
        self.refused_by_rodeira("file.cannot_open", "no_folder", env.reset, record=self.folder / "no_folder/drive.mcap")
        self.assertEqual(there.read_text(), "mine")
        env.reset(options={"record": self.folder / "fine.mcap"})
        self.assertTrue(env.step([0, 0, 0])[2])
        self.refused("has terminated", env.step, [0, 0, 0])
        self.refused("unknown topic 'vehicle_stat'.*did you mean", lambda: env.now["vehicle_stat"])
        env.close()
        env.close()
        self.refused("is closed", env.step, [0, 0, 0])
        self.refused("is closed", env.reset)
        self.assertIn("identical", run("replay", self.folder / "fine.mcap", "--verify"))

    def test_a_process_that_dies_or_hangs(self):
        env = self.env(self.alone(), "pilot", timeout_s=0.5)
        env.reset()
        os.kill(env._process._process.pid, signal.SIGKILL)
        self.refused("has ended with status -9", env.step, [0, 0, 0])
        self.refused("is closed", env.reset)
        env = self.env(self.alone(), "pilot", timeout_s=0.5)
        env.reset()
        os.kill(env._process._process.pid, signal.SIGSTOP)
        self.refused("has not answered within 0.5 s", env.step, [0, 0, 0])
        self.assertIsNotNone(env._process._process.returncode)

    def test_ctrl_c_within_a_step_closes_the_environment(self):
        class Interrupted:
            def poll(self, _):
                raise KeyboardInterrupt

        env = self.env(self.alone(), "pilot")
        env.reset(record=self.folder / "drive.mcap")
        env.step([0, 0, 0])
        env._process._poll = Interrupted()
        with self.assertRaises(KeyboardInterrupt):
            env.step([0, 0, 0])
        self.refused("is closed", env.reset)
        self.assertIn("identical", run("replay", self.folder / "drive.mcap", "--verify"))


if __name__ == "__main__":
    unittest.main()
