// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>

#include "launch/rodeira/doctor/doctor.hpp"
#include "launch/rodeira/option_errors.hpp"

namespace rodeira::cli {

void AddDoctor(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<DoctorOptions>();
  CLI::App* doctor = app.add_subcommand("doctor", "check this PC: packages, GL, DDS, ports, shared memory");
  doctor->add_option("--transport", options->transport, "of the DDS loop-back")
      ->check(OneOf({"shared_memory", "udp"}))
      ->capture_default_str();
  doctor->add_option("--domain", options->domain, "DDS domain, 0 to 232")
      ->check(Between(0, 232))
      ->capture_default_str();
  doctor->add_flag("--quiet", options->quiet, "only warnings and faults");
  doctor->add_flag("--clean", options->clean, "first remove what ended processes of yours left in /dev/shm");
  doctor->add_option("--answer", options->answer)->group("");  // the second process of the loop-back
  doctor->add_option("--segment-kib", options->segment_kib)->group("");
  doctor->add_flag("--devices", options->devices)->group("");  // by rodeira-graphics, for the doctor of `rodeira`
  chosen.When(*doctor, [options] { return Doctor(*options); });
}

}  // namespace rodeira::cli
