#include "extract/video/edit_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>

namespace stride::video {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// Big-endian; 0 beyond the end.
std::uint64_t number(std::string_view bytes, std::size_t at, std::size_t count) {
  if (bytes.size() < count || at > bytes.size() - count) return 0;
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// A box: four letters and what it holds.
struct Box {
  std::string_view name, content;
};

/// Takes the first box off; nothing where there is none, or one that is cut off.
std::optional<Box> take_box(std::string_view& bytes) {
  constexpr std::size_t kHead = 8, kLongHead = 16;
  if (bytes.size() < kHead) return std::nullopt;
  std::uint64_t size = number(bytes, 0, 4);
  const std::size_t head = size == 1 ? kLongHead : kHead;
  if (size == 1) size = number(bytes, kHead, 8);
  if (size == 0) size = bytes.size();  // to the end
  if (size < head || size > bytes.size()) return std::nullopt;
  const Box box{bytes.substr(4, 4), bytes.substr(head, size - head)};
  bytes.remove_prefix(size);
  return box;
}

std::string_view content_of(std::string_view bytes, std::string_view name) {
  while (const auto box = take_box(bytes))
    if (box->name == name) return box->content;
  return {};
}

/// Units a second, of `mvhd` and `mdhd`.
double units_a_second(std::string_view header) {
  const bool is_long = !header.empty() && header[0] == 1;
  return static_cast<double>(number(header, is_long ? 20 : 12, 4));
}

std::vector<Edit> edits_of(std::string_view list, double movie_units, double media_units) {
  const bool is_long = !list.empty() && list[0] == 1;
  const std::size_t wide = is_long ? 8 : 4, entry = 2 * wide + 4;
  std::vector<Edit> edits;
  const std::uint64_t count = number(list, 4, 4);
  for (std::size_t at = 8; edits.size() < count && at + entry <= list.size(); at += entry) {
    const std::uint64_t from = number(list, at + wide, wide);
    const auto start = is_long ? static_cast<std::int64_t>(from)
                               : static_cast<std::int32_t>(static_cast<std::uint32_t>(from));
    const auto rate =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(number(list, at + 2 * wide, 4)));
    edits.push_back({static_cast<double>(number(list, at, wide)) / movie_units,
                     start < 0 ? kNothing : static_cast<double>(start) / media_units,
                     rate / 65536.0});
  }
  return edits;
}

/// The `moov` box of a file, without its header.
std::string moov_of(const std::filesystem::path& file) {
  constexpr std::uint64_t kMost = 64 << 20;
  std::ifstream in(file, std::ios::binary);
  std::string head(16, '\0');
  for (std::uint64_t at = 0;
       in.seekg(static_cast<std::streamoff>(at)) && in.read(head.data(), 8);) {
    std::uint64_t size = number(head, 0, 4), before = 8;
    if (size == 1) {
      if (!in.read(head.data() + 8, 8)) return {};
      size = number(head, 8, 8);
      before = 16;
    }
    if (size < before || size > (std::uint64_t{1} << 50)) return {};
    if (head.compare(4, 4, "moov") == 0) {
      if (size > kMost) return {};
      std::string moov(size - before, '\0');
      in.read(moov.data(), static_cast<std::streamsize>(moov.size()));
      moov.resize(static_cast<std::size_t>(in.gcount()));
      return moov;
    }
    at += size;
  }
  return {};
}

}  // namespace

std::vector<Edit> edits_in(std::string_view moov) {
  const double movie_units = units_a_second(content_of(moov, "mvhd"));
  if (!(movie_units > 0)) return {};
  for (std::string_view rest = moov; const auto track = take_box(rest);) {
    if (track->name != "trak") continue;
    const std::string_view media = content_of(track->content, "mdia");
    constexpr std::size_t kKind = 8;  // where `hdlr` says it
    const std::string_view handler = content_of(media, "hdlr");
    if (handler.size() < kKind + 4 || handler.substr(kKind, 4) != "vide") continue;
    const double media_units = units_a_second(content_of(media, "mdhd"));
    if (!(media_units > 0)) return {};
    return edits_of(content_of(content_of(track->content, "edts"), "elst"), movie_units,
                    media_units);
  }
  return {};
}

std::vector<Edit> read_edits(const std::filesystem::path& file) { return edits_in(moov_of(file)); }

std::string text_of(const std::vector<Edit>& edits) {
  constexpr double kDelay_s = 0.1, kGap_s = 0.02;
  constexpr std::size_t kTold = 3;
  std::vector<std::string> sentences;
  const auto add = [&](std::string sentence) { sentences.push_back(std::move(sentence)); };
  double played_s = 0, end_s = kNothing;
  for (const Edit& edit : edits) {
    if (std::isnan(edit.from_s)) {
      if (edit.lasts_s >= kDelay_s)
        add(fmt::format("nothing is shown for {:.3g} s from {:.3g} s", edit.lasts_s, played_s));
    } else {
      if (std::abs(edit.from_s - end_s) > kGap_s)  // never at first
        add(fmt::format("a cut at {:.3g} s, from {:.3g} s of the recording to {:.3g} s", played_s,
                        end_s, edit.from_s));
      if (edit.rate == 0)
        add(fmt::format("one picture stands for {:.3g} s", edit.lasts_s));
      else if (std::abs(edit.rate - 1) > 0.005)
        add(fmt::format("{:.3g} s play at {:.3g} times the recorded speed", edit.lasts_s,
                        edit.rate));
      end_s = edit.from_s + edit.lasts_s * edit.rate;
    }
    played_s += edit.lasts_s;
  }
  const std::size_t told = sentences.size() > kTold + 1 ? kTold : sentences.size();
  return fmt::format("{}{}", fmt::join(sentences.begin(), sentences.begin() + told, "; "),
                     told < sentences.size()
                         ? fmt::format("; and {} more of the kind", sentences.size() - told)
                         : "");
}

}  // namespace stride::video
