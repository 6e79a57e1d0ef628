#include "train/training/replay_segments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <tuple>
#include <vector>

#include "extract/io/error.h"
#include "train/network/safetensors.h"

namespace stride::training {
namespace fs = std::filesystem;
namespace {

constexpr std::int64_t kSegmentRecords = 200'000;  // at most, of one segment

template <typename Scalar>
using Record = typename ddpg::ReplayBuffer<Scalar>::Record;

/// The records of rounds [from, to), by round and environment.
struct Segment {
  std::int64_t from = 0, to = 0;
  fs::path file;
};

fs::path segment_file(const fs::path& run, std::int64_t from, std::int64_t to) {
  return run / "replay" / fmt::format("{:012}-{:012}.safetensors", from, to);
}

std::vector<Segment> segments_of(const fs::path& run) {
  std::vector<Segment> segments;
  if (!fs::exists(run / "replay")) return segments;
  for (const auto& entry : fs::directory_iterator(run / "replay")) {
    Segment segment{.file = entry.path()};
    long long from = 0, to = 0;
    if (std::sscanf(entry.path().filename().c_str(), "%12lld-%12lld.safetensors", &from, &to) != 2)
      continue;
    segment.from = from;
    segment.to = to;
    segments.push_back(segment);
  }
  std::ranges::sort(segments, {}, &Segment::from);
  return segments;
}

template <typename Column>
void append(std::string& bytes, const Column& column) {
  bytes.append(reinterpret_cast<const char*>(column.data()),
               static_cast<std::size_t>(column.size()) * sizeof(*column.data()));
}

/// The numbers of a record, by name.
template <typename Scalar, typename Visit>
void visit_numbers(const Visit& visit) {
  visit("reward", &Record<Scalar>::reward);
  visit("phase", &Record<Scalar>::phase);
  visit("phi", &Record<Scalar>::phi);
  visit("phi_mirrored", &Record<Scalar>::phi_mirrored);
}

template <typename Scalar>
void put_records(network::Tensors& tensors, const std::vector<Record<Scalar>>& records) {
  const auto count = static_cast<Eigen::Index>(records.size());
  std::string outcomes;
  Eigen::MatrixXd poses(count, kPoseNumbers);
  for (std::size_t i = 0; i < records.size(); ++i) {
    outcomes += static_cast<char>(records[i].outcome);
    for (std::size_t k = 0; k < records[i].pose.m.size(); ++k)
      poses(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = records[i].pose.m[k];
  }
  tensors.put_bytes("outcome", outcomes);
  tensors.put("pose", poses);
  visit_numbers<Scalar>([&](const char* name, double Record<Scalar>::*member) {
    Eigen::VectorXd column(count);
    for (Eigen::Index i = 0; i < count; ++i)
      column[i] = records[static_cast<std::size_t>(i)].*member;
    tensors.put(name, column);
  });
}

template <typename Scalar>
void get_records(const network::Tensors& tensors, std::vector<Record<Scalar>>& records) {
  const auto count = static_cast<Eigen::Index>(records.size());
  const std::string& outcomes = tensors.bytes("outcome");
  require(outcomes.size() == records.size(), "{}: {} outcomes, {} are needed: of another run",
          tensors.file, outcomes.size(), records.size());
  Eigen::MatrixXd poses(count, kPoseNumbers);
  tensors.get("pose", poses);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].outcome = static_cast<ddpg::RecordKind>(outcomes[i]);
    for (std::size_t k = 0; k < records[i].pose.m.size(); ++k)
      records[i].pose.m[k] = poses(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  }
  visit_numbers<Scalar>([&](const char* name, double Record<Scalar>::*member) {
    Eigen::VectorXd column(count);
    tensors.get(name, column);
    for (Eigen::Index i = 0; i < count; ++i)
      records[static_cast<std::size_t>(i)].*member = column[i];
  });
}

/// Version 1: the bytes of structs of outcome (1 byte and 7 of nothing), reward, phase, pose, Φ, Φ
/// of the mirrored pose.
template <typename Scalar>
void get_records_version_1(const network::Tensors& tensors, std::vector<Record<Scalar>>& records) {
  constexpr std::size_t kNumbers = 4 + kPoseNumbers, kBytes = 8 + 8 * kNumbers;
  const std::string& bytes = tensors.bytes("records");
  require(bytes.size() == records.size() * kBytes,
          "{}: records of {} bytes, {} are needed: of another run", tensors.file, bytes.size(),
          records.size() * kBytes);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const char* at = bytes.data() + i * kBytes;
    double numbers[kNumbers];
    std::memcpy(numbers, at + 8, sizeof numbers);
    Record<Scalar>& record = records[i];
    record.outcome = static_cast<ddpg::RecordKind>(*at);
    record.reward = numbers[0];
    record.phase = numbers[1];
    std::copy_n(numbers + 2, record.pose.m.size(), record.pose.m.begin());
    record.phi = numbers[kNumbers - 2];
    record.phi_mirrored = numbers[kNumbers - 1];
  }
}

template <typename Scalar>
void save_segment(const ddpg::ReplayBuffer<Scalar>& buffer, std::int64_t from, std::int64_t to,
                  const fs::path& file) {
  std::string features, actions;
  std::vector<Record<Scalar>> records;
  for (std::int64_t round = from; round < to; ++round)
    for (int e = 0; e < buffer.layout().environments; ++e) {
      append(features, buffer.features(round, e));
      append(actions, buffer.action(round, e));
      records.push_back(buffer.record(round, e));
    }
  network::Tensors tensors;
  tensors.metadata = {{"format", "stride replay"}, {"version", "2"}};
  tensors.put_bytes("features", features);
  tensors.put_bytes("actions", actions);
  put_records<Scalar>(tensors, records);
  network::save(tensors, file);
}

template <typename Scalar>
void load_segment(ddpg::ReplayBuffer<Scalar>& buffer, const Segment& segment) {
  const network::Tensors tensors = network::load_tensors(segment.file);
  const auto& layout = buffer.layout();
  const auto count = static_cast<std::size_t>((segment.to - segment.from) * layout.environments);
  const auto take = [&](const char* name, std::size_t size) {
    const std::string& bytes = tensors.bytes(name);
    require(bytes.size() == count * size, "{}: {} of {} bytes, {} are needed: of another run",
            tensors.file, name, bytes.size(), count * size);
    return bytes.data();
  };
  const std::size_t feature_bytes = static_cast<std::size_t>(layout.features) * sizeof(Scalar);
  const std::size_t action_bytes = static_cast<std::size_t>(layout.actions) * sizeof(Scalar);
  const char* features = take("features", feature_bytes);
  const char* actions = take("actions", action_bytes);
  std::vector<Record<Scalar>> records(count);
  tensors.has("records") ? get_records_version_1<Scalar>(tensors, records)
                         : get_records<Scalar>(tensors, records);
  auto record = records.begin();
  for (std::int64_t round = segment.from; round < segment.to; ++round)
    for (int e = 0; e < layout.environments; ++e, ++record) {
      std::memcpy(buffer.features(round, e).data(), features, feature_bytes);
      std::memcpy(buffer.action(round, e).data(), actions, action_bytes);
      buffer.record(round, e) = *record;
      require(buffer.features(round, e).allFinite() && buffer.action(round, e).allFinite() &&
                  std::isfinite(record->reward + record->phi + record->phi_mirrored) &&
                  record->outcome <= ddpg::RecordKind::ended,
              "{}: the record of round {}, environment {} holds what is no number: damaged",
              tensors.file, round, e);
      features += feature_bytes;
      actions += action_bytes;
    }
}

}  // namespace

template <typename Scalar>
void save_new_segments(const ddpg::ReplayBuffer<Scalar>& buffer, const fs::path& run) {
  std::int64_t from = buffer.first_round();
  for (const Segment& segment : segments_of(run)) from = std::max(from, segment.to);
  const std::int64_t longest =
      std::max<std::int64_t>(1, kSegmentRecords / buffer.layout().environments);
  while (from < buffer.rounds()) {
    const std::int64_t to = std::min(from + longest, buffer.rounds());
    save_segment(buffer, from, to, segment_file(run, from, to));
    from = to;
  }
}

template <typename Scalar>
void load_segments(ddpg::ReplayBuffer<Scalar>& buffer, const fs::path& run, std::int64_t rounds) {
  buffer.set_rounds(rounds);
  std::int64_t known = buffer.first_round();
  for (const Segment& segment : segments_of(run)) {
    if (segment.from >= rounds) {  // written before a kill, after the checkpoint
      fs::remove(segment.file);
      continue;
    }
    require(segment.from <= known && segment.to <= rounds,
            "{}: the rounds from {} on are missing in {}: the replay memory is not complete",
            segment.file.string(), known, segment.file.parent_path().string());
    load_segment(buffer, segment);
    known = segment.to;
  }
  require(known == rounds, "{}: the rounds from {} to {} are missing", (run / "replay").string(),
          known, rounds);
}

template <typename Scalar>
void remove_old_segments(const ddpg::ReplayBuffer<Scalar>& buffer, const fs::path& run) {
  for (const Segment& segment : segments_of(run))
    if (segment.to <= buffer.first_round()) fs::remove(segment.file);
}

template void save_new_segments(const ddpg::ReplayBuffer<float>&, const fs::path&);
template void save_new_segments(const ddpg::ReplayBuffer<double>&, const fs::path&);
template void load_segments(ddpg::ReplayBuffer<float>&, const fs::path&, std::int64_t);
template void load_segments(ddpg::ReplayBuffer<double>&, const fs::path&, std::int64_t);
template void remove_old_segments(const ddpg::ReplayBuffer<float>&, const fs::path&);
template void remove_old_segments(const ddpg::ReplayBuffer<double>&, const fs::path&);

}  // namespace stride::training
