// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::cli {

// A line that a client asks, and where its answer (launch::AnswerLine) goes. The answer may be given later and even
// when the client has gone.
struct AskedLine {
  std::string line;
  std::function<void(const std::string&)> answer;
};

// The control socket of a run: a line in, a line out, as often as one likes on a connection
// (docs/reference/run-control.md). It has no thread: its owner calls Next() some twenty times a second.
class ControlServer {
 public:
  // Failed where a living run has this socket already, or none can be made.
  static base::Result<std::unique_ptr<ControlServer>> Open(const std::filesystem::path& socket);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  // The next complete line of any client, in the order of arrival; nothing where there is none. Never waits.
  std::optional<AskedLine> Next();

 private:
  struct Connection {
    explicit Connection(int handle) : file(handle) {}
    ~Connection();
    void Say(const std::string& line) const;
    int file;
    std::string pending;
    bool open = true;
  };
  ControlServer(int file, std::filesystem::path socket) : file_(file), socket_(std::move(socket)) {}
  void Accept();
  static void Read(Connection& connection);

  int file_;
  std::filesystem::path socket_;
  std::vector<std::shared_ptr<Connection>> connections_;
};

}  // namespace rodeira::cli
