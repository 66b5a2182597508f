// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/run_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "launch/rodeira/replay/recording_text.hpp"

namespace rodeira::cli {
namespace {

// The value of "key=" in a line of words, or an empty text.
std::string_view ValueOf(std::string_view line, std::string_view key) {
  const std::string with_equals = " " + std::string(key) + "=";
  const auto at = line.find(with_equals);
  if (at == std::string_view::npos) return {};
  line.remove_prefix(at + with_equals.size());
  return line.substr(0, line.find(' '));
}

template <class T>
T Number(std::string_view line, std::string_view key) {
  const std::string_view word = ValueOf(line, key);
  T value{};
  std::from_chars(word.data(), word.data() + word.size(), value);
  return value;
}

// The first `count` words and the rest of a line, `count` + 1 texts.
std::vector<std::string> Words(std::string_view line, std::size_t count) {
  std::vector<std::string> words;
  while (words.size() < count) {
    const auto end = std::min(line.find(' '), line.size());
    words.emplace_back(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  words.emplace_back(line);
  return words;
}

}  // namespace

void RunReport::Take(std::string_view line) {
  const auto rest = [&](std::string_view start) { return std::string(line.substr(start.size())); };
  if (line.starts_with("progress ")) {
    step = std::max(step, Number<std::int64_t>(line, "step"));  // a restarted clock has not heard all at once
    wall_s = Number<double>(line, "wall_s");
    paused = Number<int>(line, "paused") != 0;
    pace = Number<double>(line, "pace");
    if (const auto begun = Number<std::int64_t>(line, "begun_ns"); begun > 0) begun_ns = begun;
  } else if (line.starts_with("waiting for ")) {
    waiting_for = rest("waiting for ");
  } else if (line.starts_with("clock ")) {
    clock_id = Number<std::uint64_t>(line, "id");
  } else if (line.starts_with("restart ")) {
    const auto words = Words(line.substr(8), 2);
    Restart restart{words[0], 0, words[2]};
    std::from_chars(words[1].data(), words[1].data() + words[1].size(), restart.incarnation);
    if (!restart.reason.empty()) recovered.push_back(restart.reason + "; started again");
    wanted.push_back(std::move(restart));
  } else if (line.starts_with("paused ")) {
    paused_by.push_back(Words(line.substr(7), 1)[1]);
  } else if (line == "met") {
    met = true;
  } else if (line == "ready") {
    ready = true;
  } else if (line.starts_with("fault ")) {
    faults.push_back(rest("fault "));
  } else if (line.starts_with("node ")) {
    Node node;
    node.name = std::string(line.substr(5, line.find(' ', 5) - 5));
    node.steps = Number<std::uint64_t>(line, "steps");
    node.mean_us = Number<double>(line, "mean_us");
    node.worst_us = Number<double>(line, "worst_us");
    node.apart_us = Number<double>(line, "apart_us");
    node.apart_p99_us = Number<double>(line, "apart_p99_us");
    node.server_calls = Number<std::uint64_t>(line, "server_calls");
    node.cannot_save = ValueOf(line, "saves") == "0";
    nodes.push_back(node);
  } else if (line.starts_with("end ")) {
    ended = true;
    ok = line.starts_with("end ok");
    step = Number<std::int64_t>(line, "last_step");
    wall_s = Number<double>(line, "wall_s");
    slipped_s = Number<double>(line, "slipped_s");
    paused_s = Number<double>(line, "paused_s");
    paced_steps = Number<std::uint64_t>(line, "paced_steps");
    late_steps = Number<std::uint64_t>(line, "late_steps");
    late_mean_s = Number<double>(line, "late_mean_s");
    late_worst_s = Number<double>(line, "late_worst_s");
    digest = std::string(ValueOf(line, "digest"));
  } else if (!line.starts_with("starting ")) {
    remarks.emplace_back(line);
  }
}

std::string RunReport::Table(double base_step_s, const std::string& recording) const {
  const double simulated_s = static_cast<double>(std::max<std::int64_t>(step, 0)) * base_step_s;
  std::string text = fmt::format("simulated {:.3f} s in {:.2f} s ({:.2f} × real time)", simulated_s, wall_s,
                                 wall_s > 0.0 ? simulated_s / wall_s : 0.0);
  if (paused_s > 0.0) text += fmt::format(", of it paused {:.2f} s", paused_s);
  if (paced_steps > 0) {
    text += fmt::format("\nlate    mean {:.3f} ms, worst {:.3f} ms, {} of {} steps late, {:.3f} s dropped",
                        late_mean_s * 1e3, late_worst_s * 1e3, late_steps, paced_steps, slipped_s);
  }
  std::size_t width = 4;
  for (const Node& node : nodes) width = std::max(width, node.name.size());
  // Computing a step, and from one step to the next.
  text += fmt::format("\n{:<{}}  {:>9}  {:>10}  {:>10}  {:>10}  {:>10}  {:>12}\n", "node", width, "steps", "mean µs",
                      "worst µs", "period µs", "99 % µs", "server calls");
  for (const Node& node : nodes) {
    text += fmt::format("{:<{}}  {:>9}  {:>9.2f}  {:>9.1f}  {:>9.1f}  {:>9.1f}  {:>12}\n", node.name, width, node.steps,
                        node.mean_us, node.worst_us, node.apart_us, node.apart_p99_us, node.server_calls);
  }
  for (const Node& node : nodes) {
    if (node.cannot_save) text += WithoutStateLine(node.name);
  }
  if (faults.empty() && recovered.empty()) text += "faults  none\n";
  for (const std::string& again : recovered) text += fmt::format("again   {}\n", again);
  for (const std::string& fault : faults) text += fmt::format("fault   {}\n", fault);
  if (ok) text += fmt::format("digest  {}\n", digest);
  return text + WrittenFile(recording, simulated_s);
}

}  // namespace rodeira::cli
