// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/reader_listeners.hpp"

#include <dlfcn.h>
#include <fastdds/rtps/reader/RTPSReader.h>
#include <fastdds/rtps/reader/ReaderListener.h>

#include <mutex>

namespace eprosima::fastrtps::rtps {

// The dynamic linker takes a function of the program itself before a library's.
bool RTPSReader::setListener(ReaderListener* target) {
  static ReaderListener* const nothing = new ReaderListener;  // never deleted: threads of the library outlive statics
  const std::lock_guard<RecursiveTimedMutex> lock(mp_mutex);
  mp_listener = target == nullptr ? nothing : target;
  return true;
}

}  // namespace eprosima::fastrtps::rtps

namespace rodeira::dds {

bool DeletedReadersHaveListeners() {
  using eprosima::fastrtps::rtps::RTPSReader;
  constexpr auto kOurs = &RTPSReader::setListener;
  // A pointer to a member function that is not virtual begins with the function's address.
  void* ours = nullptr;
  static_assert(sizeof(kOurs) >= sizeof(ours));
  __builtin_memcpy(&ours, &kOurs, sizeof(ours));
  return ::dlsym(RTLD_DEFAULT, "_ZN8eprosima8fastrtps4rtps10RTPSReader11setListenerEPNS1_14ReaderListenerE") == ours;
}

}  // namespace rodeira::dds
