// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/participant.hpp"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fmt/format.h>

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>

#include "common/core/base/recycled_bytes.hpp"
#include "common/runtime/dds/library_log.hpp"
#include "common/runtime/dds/participant_qos.hpp"
#include "common/runtime/dds/raw_type.hpp"
#include "common/runtime/dds/reader_listeners.hpp"
#include "common/runtime/dds/robust_mutexes.hpp"
#include "common/runtime/dds/shared_memory_room.hpp"
#include "common/runtime/dds/udp_port.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

namespace fdds = eprosima::fastdds::dds;
using eprosima::fastrtps::Duration_t;

class FastWriter final : public Writer, public fdds::DataWriterListener {
 public:
  FastWriter(fdds::Publisher* publisher, std::string topic, bool is_kept)
      : publisher_(publisher), topic_(std::move(topic)), is_kept_(is_kept) {}
  ~FastWriter() override {
    if (writer_ == nullptr) return;
    writer_->set_listener(nullptr);
    publisher_->delete_datawriter(writer_);
  }
  void Begin(fdds::DataWriter* writer) { writer_ = writer; }

  void on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& status) override {
    readers_ = status.current_count;
  }
  base::Status Write(const base::Bytes& payload) override {
    if (!is_kept_ && readers_ == 0) return {};  // nothing keeps it for a reader that comes later
    RawSample sample;
    sample.to_send = &payload;
    if (!writer_->write(&sample))
      return base::Failed("dds.no_endpoint", "Fast DDS does not take a sample", "topic " + topic_);
    return {};
  }

 private:
  fdds::Publisher* publisher_;
  fdds::DataWriter* writer_ = nullptr;
  std::string topic_;
  const bool is_kept_;
  std::atomic<std::int32_t> readers_ = 0;
};

class FastReader final : public Reader, public fdds::DataReaderListener {
 public:
  FastReader(fdds::Subscriber* subscriber, OnPayload on_payload)
      : subscriber_(subscriber), on_payload_(std::move(on_payload)) {}
  ~FastReader() override {
    if (reader_ == nullptr) return;
    reader_->set_listener(nullptr);
    subscriber_->delete_datareader(reader_);
  }
  void Begin(fdds::DataReader* reader) { reader_ = reader; }

  void on_data_available(fdds::DataReader* reader) override {
    RawSample sample;
    fdds::SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) on_payload_(std::move(sample.bytes));
    }
    base::RecycleBytes(std::move(sample.bytes));
  }

 private:
  fdds::Subscriber* subscriber_;
  fdds::DataReader* reader_ = nullptr;
  OnPayload on_payload_;
};

class FastParticipant final : public Participant {
 public:
  FastParticipant(fdds::DomainParticipant* participant, fdds::Publisher* publisher, fdds::Subscriber* subscriber,
                  idl::TopicTable table)
      : participant_(participant), publisher_(publisher), subscriber_(subscriber), table_(std::move(table)) {}
  ~FastParticipant() override {
    participant_->delete_contained_entities();
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  base::Result<std::unique_ptr<Writer>> MakeWriter(std::string_view topic, Delivery delivery) override {
    auto* made_topic = TopicOf(topic);
    if (made_topic == nullptr) return Refused(topic);
    fdds::DataWriterQos qos = fdds::DATAWRITER_QOS_DEFAULT;
    Common(qos, delivery);
    qos.durability().kind = IsKept(delivery) ? fdds::TRANSIENT_LOCAL_DURABILITY_QOS : fdds::VOLATILE_DURABILITY_QOS;
    qos.reliability().kind =
        delivery == Delivery::kBestEffortRepeated ? fdds::BEST_EFFORT_RELIABILITY_QOS : fdds::RELIABLE_RELIABILITY_QOS;
    auto& times = qos.reliable_writer_qos().times;
    times.initialHeartbeatDelay = Duration_t{0, 0};
    times.heartbeatPeriod = Duration_t{0, 3u * kNanosecondsPerMillisecond};
    times.nackResponseDelay = Duration_t{0, 0};
    times.nackSupressionDuration = Duration_t{0, 0};
    auto writer = std::make_unique<FastWriter>(publisher_, std::string(topic), IsKept(delivery));
    fdds::DataWriter* made =
        publisher_->create_datawriter(made_topic, qos, writer.get(), fdds::StatusMask::publication_matched());
    if (made == nullptr) return Refused(topic);
    writer->Begin(made);
    return std::unique_ptr<Writer>(std::move(writer));
  }

  base::Result<std::unique_ptr<Reader>> MakeReader(std::string_view topic, Delivery delivery,
                                                   OnPayload on_payload) override {
    auto* made_topic = TopicOf(topic);
    if (made_topic == nullptr) return Refused(topic);
    fdds::DataReaderQos qos = fdds::DATAREADER_QOS_DEFAULT;
    Common(qos, delivery);
    qos.durability().kind = IsKept(delivery) ? fdds::TRANSIENT_LOCAL_DURABILITY_QOS : fdds::VOLATILE_DURABILITY_QOS;
    const bool best_effort = delivery == Delivery::kObserve || delivery == Delivery::kBestEffortRepeated;
    qos.reliability().kind = best_effort ? fdds::BEST_EFFORT_RELIABILITY_QOS : fdds::RELIABLE_RELIABILITY_QOS;
    qos.reliable_reader_qos().times.heartbeatResponseDelay = Duration_t{0, 0};
    auto reader = std::make_unique<FastReader>(subscriber_, std::move(on_payload));
    fdds::DataReader* made = subscriber_->create_datareader(made_topic, qos, reader.get());
    if (made == nullptr) return Refused(topic);
    reader->Begin(made);
    return std::unique_ptr<Reader>(std::move(reader));
  }

 private:
  static bool IsKept(Delivery delivery) { return delivery == Delivery::kLatched || delivery == Delivery::kHistory; }
  template <class Qos>
  static void Common(Qos& qos, Delivery delivery) {
    qos.history().kind = fdds::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = delivery == Delivery::kLatched ? 1 : 256;  // of all writers together: the types have no keys
    qos.resource_limits().max_samples = 1000;
    qos.resource_limits().max_instances = 1;
    qos.resource_limits().max_samples_per_instance = 1000;
    qos.resource_limits().allocated_samples = 64;
    qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
  }
  static base::Error Refused(std::string_view topic) {
    return base::Failed("dds.no_endpoint", "Fast DDS makes no endpoint for this topic", "topic " + std::string(topic));
  }

  fdds::Topic* TopicOf(std::string_view name) {
    const auto schema = table_.SchemaOf(name);
    if (!schema) return nullptr;
    const std::lock_guard lock(mutex_);
    auto& topic = topics_[std::string(name)];
    if (topic == nullptr) {
      const std::string& type_name = schema->type;
      if (participant_->find_type(type_name).empty())
        fdds::TypeSupport(new RawType(type_name)).register_type(participant_);
      topic = participant_->create_topic(std::string(name), type_name, fdds::TOPIC_QOS_DEFAULT);
    }
    return topic;
  }

  fdds::DomainParticipant* participant_;
  fdds::Publisher* publisher_;
  fdds::Subscriber* subscriber_;
  const idl::TopicTable table_;
  std::mutex mutex_;
  std::map<std::string, fdds::Topic*, std::less<>> topics_;
};

}  // namespace

base::Result<std::unique_ptr<Participant>> Participant::Open(const DomainSettings& settings) {
  RODEIRA_ASSERT(!settings.run.empty());
  RODEIRA_ASSERT(SharedMutexesAreRobust() && DeletedReadersHaveListeners());
  const launch::Discovery& discovery = settings.discovery;
  if (settings.serves_discovery && discovery.kind == launch::DiscoveryKind::kServer && !UdpPortIsFree(discovery.port)) {
    return base::WrongInput("dds.port_in_use",
                            fmt::format("UDP port {} of the discovery server is in use by another program; end that "
                                        "one, or name another 'discovery.port'",
                                        discovery.port),
                            fmt::format("run '{}'", settings.run));
  }
  const bool is_shared = settings.transport == launch::Transport::kSharedMemory;
  if (is_shared) {
    if (auto status = CheckSpace(SharedMemoryNeed(settings.segment_kib)); !status) return status.error();
  }
  RedirectLibraryLog();
  if (!settings.delivers_within) {
    eprosima::fastrtps::LibrarySettingsAttributes library;
    library.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(library);
  }
  auto* factory = fdds::DomainParticipantFactory::get_instance();
  auto* participant = factory->create_participant(settings.domain, ParticipantQos(settings));
  if (participant == nullptr) {
    return base::Failed(
        "dds.no_participant",
        fmt::format(
            "Fast DDS makes no participant in domain {} (is /dev/shm writable, are ports {} and following free?)",
            settings.domain, 7400 + 250 * settings.domain));
  }
  if (auto status = is_shared ? ClaimOwnSegment() : base::Status(); !status) {
    factory->delete_participant(participant);
    return status.error();
  }
  fdds::PublisherQos publisher_qos = fdds::PUBLISHER_QOS_DEFAULT;
  publisher_qos.partition().push_back(("rodeira/" + settings.run).c_str());
  fdds::SubscriberQos subscriber_qos = fdds::SUBSCRIBER_QOS_DEFAULT;
  subscriber_qos.partition().push_back(("rodeira/" + settings.run).c_str());
  auto* publisher = participant->create_publisher(publisher_qos);
  auto* subscriber = participant->create_subscriber(subscriber_qos);
  if (publisher == nullptr || subscriber == nullptr) {
    factory->delete_participant(participant);
    return base::Failed("dds.no_endpoint", "Fast DDS makes no publisher and subscriber");
  }
  return std::unique_ptr<Participant>(
      std::make_unique<FastParticipant>(participant, publisher, subscriber, settings.topics));
}

}  // namespace rodeira::dds
