// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/fmi/unit.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/printable.hpp"
#include "common/vehicle/fmi/archive.hpp"
#include "common/vehicle/fmi/fmi2.hpp"
#include "common/vehicle/fmi/trial.hpp"

namespace rodeira::fmi {
namespace {

namespace fs = std::filesystem;

// The functions of a loaded FMU. Those of its state may be null.
struct Functions {
  InstantiateFunction* instantiate = nullptr;
  FreeInstanceFunction* free_instance = nullptr;
  SetupExperimentFunction* setup_experiment = nullptr;
  ComponentFunction* enter_initialisation = nullptr;
  ComponentFunction* exit_initialisation = nullptr;
  ComponentFunction* terminate = nullptr;
  ComponentFunction* reset = nullptr;  // may be null
  GetRealFunction* get_real = nullptr;
  SetRealFunction* set_real = nullptr;
  GetIntegerFunction* get_integer = nullptr;
  SetIntegerFunction* set_integer = nullptr;
  GetIntegerFunction* get_boolean = nullptr;
  SetIntegerFunction* set_boolean = nullptr;
  DoStepFunction* do_step = nullptr;
  GetStateFunction* get_state = nullptr;
  SetStateFunction* set_state = nullptr;
  GetStateFunction* free_state = nullptr;
  StateSizeFunction* state_size = nullptr;
  SerializeFunction* serialize = nullptr;
  DeserializeFunction* deserialize = nullptr;
};

const char* Word(fmi2Status status) {
  constexpr std::array kWords = {"ok", "warning", "discard", "error", "fatal", "pending"};
  const auto index = static_cast<std::size_t>(status);
  return index < kWords.size() ? kWords[index] : "an unknown status";
}

// The FMU's last remark that was no fine word.
void Log(fmi2ComponentEnvironment environment, fmi2String, fmi2Status status, fmi2String, fmi2String message, ...) {
  if (environment == nullptr || message == nullptr || status == fmi2OK) return;
  std::array<char, 500> text{};
  va_list arguments;
  va_start(arguments, message);
  (void)std::vsnprintf(text.data(), text.size(), message, arguments);
  va_end(arguments);
  *static_cast<std::string*>(environment) = text.data();
}

// What an FMU that is called no more still holds stays held to the end of the program.
void Abandon(fmi2Component component) {
  static std::mutex mutex;
  static auto* const all = new std::vector<fmi2Component>;
  const std::lock_guard lock(mutex);
  all->push_back(component);
}

// Which FMUs that allow one instance a process have one here, by guid.
class OnlyOnce {
 public:
  static bool IsTaken(const std::string& guid) {
    const std::lock_guard lock(Mutex());
    return Taken().contains(guid);
  }
  static void Note(const std::string& guid) {
    const std::lock_guard lock(Mutex());
    Taken().insert(guid);
  }
  static void Forget(const std::string& guid) {
    const std::lock_guard lock(Mutex());
    Taken().erase(guid);
  }

 private:
  static std::mutex& Mutex() {
    static std::mutex mutex;
    return mutex;
  }
  static std::set<std::string>& Taken() {
    static auto* const taken = new std::set<std::string>;
    return *taken;
  }
};

class LoadedInstance final : public Instance {
 public:
  LoadedInstance(Functions& functions, const Description& description, std::string file)
      : f_(functions), description_(description), file_(std::move(file)) {}
  ~LoadedInstance() override {
    if (component_ == nullptr) return;
    if (description_.only_once) OnlyOnce::Forget(description_.guid);
    if (dead_) {  // after "fatal" nothing may be called
      Abandon(component_);
      return;
    }
    if (runs_ && !failed_) {
      const base::ForeignCall call("fmi2Terminate", owner_.c_str());
      (void)f_.terminate(component_);
    }
    const base::ForeignCall call("fmi2FreeInstance", owner_.c_str());
    f_.free_instance(component_);
  }
  LoadedInstance(const LoadedInstance&) = delete;
  LoadedInstance& operator=(const LoadedInstance&) = delete;

  base::Status Make(const std::string& name, const fs::path& resources) {
    callbacks_ = {&Log, &std::calloc, &std::free, nullptr, &said_};
    const std::string where = "file://" + resources.string();
    owner_ = base::Printable(fmt::format("FMU '{}' (instance '{}')", file_, name));
    {
      const base::ForeignCall call("fmi2Instantiate", owner_.c_str());
      component_ =
          f_.instantiate(name.c_str(), fmi2CoSimulation, description_.guid.c_str(), where.c_str(), &callbacks_, 0, 0);
    }
    if (component_ != nullptr) {
      if (description_.only_once) OnlyOnce::Note(description_.guid);
      return {};
    }
    return base::WrongInput(
        "fmu.no_instance",
        fmt::format("fmi2Instantiate: the FMU makes no instance of itself{}", said_.empty() ? "" : ": " + said_),
        file_);
  }

  base::Status Reset() override {
    if (f_.reset == nullptr)
      return base::WrongInput("fmu.one_instance_a_process",
                              "its binary has no function 'fmi2Reset', and the FMU allows one instance a process",
                              file_);
    runs_ = false;
    return Call("fmi2Reset", [&] { return f_.reset(component_); });
  }
  base::Status EnterInitialisation(double time_s) override {
    if (auto status =
            Call("fmi2SetupExperiment", [&] { return f_.setup_experiment(component_, 0, 0.0, time_s, 0, 0.0); });
        !status)
      return status;
    return Call("fmi2EnterInitializationMode", [&] { return f_.enter_initialisation(component_); });
  }
  base::Status ExitInitialisation() override {
    runs_ = true;
    return Call("fmi2ExitInitializationMode", [&] { return f_.exit_initialisation(component_); });
  }
  base::Status Set(const Variable& variable, double value) override {
    const fmi2ValueReference reference = variable.reference;
    if (variable.type == VariableType::kReal)
      return Call(
          "fmi2SetReal", [&] { return f_.set_real(component_, &reference, 1, &value); }, &variable);
    const auto whole = static_cast<fmi2Integer>(std::lround(std::clamp(value, -1e9, 1e9)));
    if (variable.type == VariableType::kInteger)
      return Call(
          "fmi2SetInteger", [&] { return f_.set_integer(component_, &reference, 1, &whole); }, &variable);
    const fmi2Boolean truth = value != 0.0;
    return Call(
        "fmi2SetBoolean", [&] { return f_.set_boolean(component_, &reference, 1, &truth); }, &variable);
  }
  base::Result<double> Get(const Variable& variable) override {
    const fmi2ValueReference reference = variable.reference;
    double real = 0.0;
    int whole = 0;
    base::Status status;
    if (variable.type == VariableType::kReal)
      status = Call(
          "fmi2GetReal", [&] { return f_.get_real(component_, &reference, 1, &real); }, &variable);
    else if (variable.type == VariableType::kInteger)
      status = Call(
          "fmi2GetInteger", [&] { return f_.get_integer(component_, &reference, 1, &whole); }, &variable);
    else
      status = Call(
          "fmi2GetBoolean", [&] { return f_.get_boolean(component_, &reference, 1, &whole); }, &variable);
    if (!status) return status.error();
    return variable.type == VariableType::kReal ? real : static_cast<double>(whole);
  }
  base::Status DoStep(double time_s, double step_s) override {
    return Call("fmi2DoStep", [&] { return f_.do_step(component_, time_s, step_s, 0); });
  }

  base::Result<base::Bytes> State() override {
    fmi2FMUstate state = nullptr;
    std::size_t size = 0;
    if (auto status = Call("fmi2GetFMUstate", [&] { return f_.get_state(component_, &state); }); !status)
      return status.error();
    if (auto status = Call("fmi2SerializedFMUstateSize", [&] { return f_.state_size(component_, state, &size); });
        !status)
      return status.error();
    base::Bytes bytes(size);
    if (auto status =
            Call("fmi2SerializeFMUstate",
                 [&] { return f_.serialize(component_, state, reinterpret_cast<fmi2Byte*>(bytes.data()), size); });
        !status)
      return status.error();
    if (auto status = Call("fmi2FreeFMUstate", [&] { return f_.free_state(component_, &state); }); !status)
      return status.error();
    return bytes;
  }
  base::Status SetState(std::span<const std::byte> bytes) override {
    fmi2FMUstate state = nullptr;
    const auto* raw = reinterpret_cast<const fmi2Byte*>(bytes.data());
    if (auto status =
            Call("fmi2DeSerializeFMUstate", [&] { return f_.deserialize(component_, raw, bytes.size(), &state); });
        !status)
      return status;
    if (auto status = Call("fmi2SetFMUstate", [&] { return f_.set_state(component_, state); }); !status) return status;
    return Call("fmi2FreeFMUstate", [&] { return f_.free_state(component_, &state); });
  }

 private:
  template <class Function>
  base::Status Call(const char* name, const Function& function, const Variable* variable = nullptr) {
    if (dead_)
      return base::Failed("fmu.call_failed",
                          fmt::format("{}: not called, the FMU has ended with a fatal error before", name), file_);
    const fmi2Status status = [&] {
      const base::ForeignCall call(name, owner_.c_str());
      return function();
    }();
    if (status == fmi2OK || status == fmi2Warning) return {};
    failed_ = true;
    dead_ = status == fmi2Fatal;
    return base::Failed("fmu.call_failed",
                        fmt::format("{}{}: {}{}", name, variable == nullptr ? "" : " of '" + variable->name + "'",
                                    Word(status), said_.empty() ? "" : ": " + said_),
                        file_);
  }
  Functions& f_;
  const Description& description_;
  std::string file_;
  std::string owner_;  // for a crash
  std::string said_;
  fmi2CallbackFunctions callbacks_{};
  fmi2Component component_ = nullptr;
  bool runs_ = false;
  bool failed_ = false;
  bool dead_ = false;
};

std::vector<std::string> FilesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(folder, problem))
    if (entry.is_regular_file(problem)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

// The platforms that an FMU has binaries for; for this one with their names.
std::string Platforms(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code problem;
  for (const auto& entry : fs::directory_iterator(folder / "binaries", problem)) {
    const std::vector<std::string> files = FilesIn(entry.path());
    const std::string name = entry.path().filename().string();
    if (files.empty()) continue;
    names.push_back(name == "linux64" ? fmt::format("{} ({})", name, fmt::join(files, ", ")) : name);
  }
  std::sort(names.begin(), names.end());
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

class LoadedUnit final : public Unit {
 public:
  LoadedUnit(const fs::path& folder, Description description, const std::string& file)
      : path_(folder),
        description_(std::move(description)),
        file_(file),
        owner_(base::Printable(fmt::format("FMU '{}'", file))) {}
  ~LoadedUnit() override {
    const base::ForeignCall call("unloading", owner_.c_str());
    if (library_ != nullptr) (void)::dlclose(library_);
  }
  LoadedUnit(const LoadedUnit&) = delete;
  LoadedUnit& operator=(const LoadedUnit&) = delete;

  // The folder is removed with it.
  void Own(base::TemporaryFolder folder) { folder_.emplace(std::move(folder)); }

  base::Status Open() {
    const fs::path binary = path_ / "binaries/linux64" / (description_.identifier + ".so");
    std::error_code problem;
    if (!fs::is_regular_file(binary, problem)) {
      return base::WrongInput(
          "fmu.no_binary",
          fmt::format("this FMU has no binaries/linux64/{}.so; the platforms that it has binaries for: {}",
                      description_.identifier, Platforms(path_)),
          file_);
    }
    {
      const base::ForeignCall call("loading", owner_.c_str());
      library_ = ::dlopen(binary.c_str(), RTLD_NOW | RTLD_LOCAL);
    }
    if (library_ == nullptr)
      return base::WrongInput("fmu.wrong_binary", fmt::format("its binary cannot be loaded: {}", ::dlerror()), file_);
    Find("fmi2Instantiate", f_.instantiate);
    Find("fmi2FreeInstance", f_.free_instance);
    Find("fmi2SetupExperiment", f_.setup_experiment);
    Find("fmi2EnterInitializationMode", f_.enter_initialisation);
    Find("fmi2ExitInitializationMode", f_.exit_initialisation);
    Find("fmi2Terminate", f_.terminate);
    f_.reset = reinterpret_cast<ComponentFunction*>(::dlsym(library_, "fmi2Reset"));
    Find("fmi2GetReal", f_.get_real);
    Find("fmi2SetReal", f_.set_real);
    Find("fmi2GetInteger", f_.get_integer);
    Find("fmi2SetInteger", f_.set_integer);
    Find("fmi2GetBoolean", f_.get_boolean);
    Find("fmi2SetBoolean", f_.set_boolean);
    Find("fmi2DoStep", f_.do_step);
    if (description_.can_get_state && description_.can_serialize_state) {
      Find("fmi2GetFMUstate", f_.get_state);
      Find("fmi2SetFMUstate", f_.set_state);
      Find("fmi2FreeFMUstate", f_.free_state);
      Find("fmi2SerializedFMUstateSize", f_.state_size);
      Find("fmi2SerializeFMUstate", f_.serialize);
      Find("fmi2DeSerializeFMUstate", f_.deserialize);
    }
    if (missing_.empty()) return {};
    return base::WrongInput("fmu.wrong_binary",
                            fmt::format("its binary has no function '{}', which FMI 2.0 asks of it", missing_), file_);
  }

  const Description& description() const override { return description_; }
  bool can_save_state() const override {
    return description_.can_get_state && description_.can_serialize_state && note_.empty();
  }
  const std::string& note() const override { return note_; }
  void set_note(std::string note) { note_ = std::move(note); }
  base::Result<std::unique_ptr<Instance>> Instantiate(const std::string& name) override {
    if (description_.only_once && OnlyOnce::IsTaken(description_.guid)) {
      return base::WrongInput(
          "fmu.one_instance_a_process",
          "a process may have one instance of this FMU only (canBeInstantiatedOnlyOncePerProcess), and this process "
          "has "
          "one already; vehicles with it were expected in processes of their own, without --in-process",
          file_);
    }
    auto instance = std::make_unique<LoadedInstance>(f_, description_, file_);
    if (auto status = instance->Make(name, path_ / "resources"); !status) return status.error();
    return std::unique_ptr<Instance>(std::move(instance));
  }

 private:
  template <class Function>
  void Find(const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(::dlsym(library_, name));
    if (function == nullptr && missing_.empty()) missing_ = name;
  }

  std::optional<base::TemporaryFolder> folder_;
  fs::path path_;
  Description description_;
  std::string file_;
  std::string owner_;  // for a crash
  void* library_ = nullptr;
  Functions f_;
  std::string missing_;
  std::string note_;
};

base::Result<std::unique_ptr<LoadedUnit>> LoadFolder(const fs::path& folder, const std::string& file, bool with_trial) {
  auto description = ReadDescription(folder / "modelDescription.xml", file);
  if (!description) return description.error();
  std::string note;
  if (with_trial) {
    if (auto status = TryInProcessOfItsOwn(folder, file); !status) return status.error();
    if (description.value().can_get_state && description.value().can_serialize_state) {
      if (auto status = TryStateInProcessOfItsOwn(folder, file); !status) {
        note = fmt::format(
            "the state that it saves is of no use to another process ({}); runs with it are computed again "
            "from step 0",
            status.error().message);
      }
    }
  }
  auto unit = std::make_unique<LoadedUnit>(folder, std::move(description).value(), file);
  if (auto status = unit->Open(); !status) return status.error();
  unit->set_note(std::move(note));
  return unit;
}

}  // namespace

base::Result<std::unique_ptr<Unit>> Unit::Load(const fs::path& fmu) {
  auto folder = Unpack(fmu);
  if (!folder) return folder.error();
  auto unit = LoadFolder(folder.value().path(), fmu.string(), true);
  if (!unit) return unit.error();
  unit.value()->Own(std::move(folder).value());
  return std::unique_ptr<Unit>(std::move(unit).value());
}

base::Result<std::unique_ptr<Unit>> Unit::LoadUnpacked(const fs::path& folder, const std::string& file) {
  auto unit = LoadFolder(folder, file, false);
  if (!unit) return unit.error();
  return std::unique_ptr<Unit>(std::move(unit).value());
}

}  // namespace rodeira::fmi
