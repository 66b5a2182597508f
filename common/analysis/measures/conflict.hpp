// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/analysis/measures/measure.hpp"

// Measures of an approach to the leader. Gaps are from the own front bumper to the leader's rear, along the lane.
namespace rodeira::measures {

// gap / (own - leader), s (Hayward 1972); missing unless the vehicle closes in. 0 where the gap is 0 or below.
double TimeToCollision_s(double gap_m, double own_mps, double leader_mps);
// With both accelerations: the first root of gap - dv t - da t^2 / 2 at or after 0; missing where there is none.
double TimeToCollision_s(double gap_m, double own_mps, double leader_mps, double own_mps2, double leader_mps2);
// Deceleration rate to avoid the crash: dv^2 / (2 gap), m/s^2; missing unless the vehicle closes in, or without a gap.
double Drac_mps2(double gap_m, double own_mps, double leader_mps);
// Modified DRAC: dv / (2 (TTC - reaction time)); missing where TTC is missing, or not above the reaction time.
double ModifiedDrac_mps2(double ttc_s, double closing_mps, double reaction_s = 1.0);
// Deceleration that stops behind a leader that brakes by leader_mps2 (above 0) to rest: v^2 / (2 (gap + v_l^2 / (2
// b))).
double BrakingLeaderDrac_mps2(double gap_m, double own_mps, double leader_mps, double leader_mps2);

// The first of these for each sample.
std::vector<double> TtcSeries(Series gap_m, Series own_mps, Series leader_mps);
// Drac_mps2 of each sample. Precondition: three series of one length.
std::vector<double> DracSeries(Series gap_m, Series own_mps, Series leader_mps);

// Time exposed: the time in which TTC is below the threshold, s; and the integral of threshold - TTC over it, s^2
// (Minderhoud & Bovy 2001). n counts the samples with a leader; without one both are missing.
Measure TimeExposedTtc(Series ttc_s, Series gap_m, double rate_hz, double threshold_s);
// The time integral of (threshold - TTC) while TTC is below the threshold, s^2 (Minderhoud and Bovy 2001).
Measure TimeIntegratedTtc(Series ttc_s, Series gap_m, double rate_hz, double threshold_s);
// The least TTC, and the mean of 1/TTC with 0 where the vehicle does not close in. Missing without a leader.
Measure LeastTtc(Series ttc_s, Series gap_m);
// The mean of 1/TTC, 1/s; 0 where the vehicle does not close in.
Measure MeanInverseTtc(Series ttc_s, Series gap_m);

}  // namespace rodeira::measures
