#include "io/basis_etc1s.h"

#include <algorithm>
#include <stdexcept>

namespace candil {
namespace {

/// How far the inner and the outer two shades lie from the base colour: Khronos Data Format Specification 1.3, section
/// 21.1, table of the intensity modifiers of ETC1.
constexpr std::array<std::array<int, 2>, 8> modifiers = {
    {{2, 8}, {5, 17}, {9, 29}, {13, 42}, {18, 60}, {24, 80}, {33, 106}, {47, 183}}};

glm::u8vec4 shade(const std::array<std::uint32_t, 3>& base, int offset) {
  glm::u8vec4 texel(255);
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t five_bits = base[static_cast<std::size_t>(i)];
    const int eight_bits = static_cast<int>(five_bits << 3 | five_bits >> 2);
    texel[i] = static_cast<std::uint8_t>(std::clamp(eight_bits + offset, 0, 255));
  }
  return texel;
}

}  // namespace

Etc1sDecoder::Etc1sDecoder(const Etc1sPalettes& palettes)
    : tables_(palettes.tables),
      prediction_code_(BasisHuffmanCode::read(tables_)),
      endpoint_code_(BasisHuffmanCode::read(tables_)),
      selector_code_(BasisHuffmanCode::read(tables_)),
      repeat_code_(BasisHuffmanCode::read(tables_)),
      recent_count_(tables_.read(13)) {
  if (palettes.endpoint_count == 0 || palettes.selector_count == 0)
    throw std::runtime_error("the palettes of ETC1S are empty");
  read_endpoints(palettes);
  read_selectors(palettes);
}

void Etc1sDecoder::read_endpoints(const Etc1sPalettes& palettes) {
  BasisBitReader bits(palettes.endpoints);
  const BasisHuffmanCode after_dark = BasisHuffmanCode::read(bits), after_middle = BasisHuffmanCode::read(bits),
                         after_bright = BasisHuffmanCode::read(bits), intensity_code = BasisHuffmanCode::read(bits);
  const bool is_grey = bits.read(1) != 0;
  std::array<std::uint32_t, 3> base = {16, 16, 16};
  std::uint32_t intensity = 0;
  for (std::uint32_t i = 0; i < palettes.endpoint_count; ++i) {
    intensity = (intensity + intensity_code.decode(bits)) & 7;
    for (std::size_t channel = 0; channel < (is_grey ? 1 : 3); ++channel) {
      std::uint32_t& value = base[channel];
      const BasisHuffmanCode& code = value <= 9 ? after_dark : value <= 21 ? after_middle : after_bright;
      value = (value + code.decode(bits)) & 31;
    }
    if (is_grey) base[1] = base[2] = base[0];
    const auto [inner, outer] = modifiers[intensity];
    endpoints_.push_back({shade(base, -outer), shade(base, -inner), shade(base, inner), shade(base, outer)});
  }
}

void Etc1sDecoder::read_selectors(const Etc1sPalettes& palettes) {
  BasisBitReader bits(palettes.selectors);
  if (bits.read(2) != 0) throw std::runtime_error("a palette of selectors of an unknown kind");
  const bool is_raw = bits.read(1) != 0;
  const BasisHuffmanCode code =
      is_raw ? BasisHuffmanCode(std::span<const std::uint8_t>()) : BasisHuffmanCode::read(bits);
  std::uint32_t previous = 0;
  for (std::uint32_t i = 0; i < palettes.selector_count; ++i) {
    std::uint32_t selector = 0;  // as stored: a byte for each row, first texel lowest
    for (int row = 0; row < 4; ++row) {
      const std::uint32_t byte = is_raw || i == 0 ? bits.read(8) : code.decode(bits);
      if (byte > 255) throw std::runtime_error("a selector is no byte");
      selector |= byte << 8 * row;
    }
    if (!is_raw) selector ^= previous;
    selectors_.push_back(previous = selector);
  }
}

Etc1sDecoder::SliceReader::SliceReader(const Etc1sDecoder& decoder, std::span<const std::byte> slice,
                                       std::uint32_t columns)
    : decoder_(decoder),
      bits_(slice),
      upper_endpoints_(columns),
      lower_predictions_((columns + 1) / 2),
      recent_(decoder.recent_count_),
      recent_end_(decoder.recent_count_ / 2) {}

Etc1sDecoder::Block Etc1sDecoder::SliceReader::next(std::uint32_t column, std::uint32_t row) {
  if (column % 2 == 0) read_predictions(column, row);
  const Shades& shades = decoder_.endpoints_[next_endpoint(column, row)];
  const std::uint32_t selector = decoder_.selectors_[next_selector()];
  Block block;
  for (std::uint32_t i = 0; i < 16; ++i) block[i] = shades[selector >> 2 * i & 3];
  return block;
}

/// A symbol tells for 2 x 2 blocks where each has its endpoint from, in 2 bits a block.
void Etc1sDecoder::SliceReader::read_predictions(std::uint32_t column, std::uint32_t row) {
  constexpr std::uint32_t repeat_symbol = 256, shortest_run = 3;
  if (row % 2 != 0) {
    predictions_ = lower_predictions_[column / 2];
    return;
  }
  if (prediction_repeats_ > 0) {
    --prediction_repeats_;
  } else {
    const std::uint32_t symbol = decoder_.prediction_code_.decode(bits_);
    if (symbol > repeat_symbol) throw std::runtime_error("a prediction of endpoints is out of range");
    if (symbol == repeat_symbol) {
      // A run beyond the last block is as good as one that reaches it: no sum, no overflow.
      prediction_repeats_ = std::min(bits_.read_variable(4), ~0u - shortest_run) + shortest_run - 1;
    } else {
      last_predictions_ = symbol;
    }
  }
  predictions_ = last_predictions_;
  lower_predictions_[column / 2] = static_cast<std::uint8_t>(predictions_ >> 4);
}

std::uint32_t Etc1sDecoder::SliceReader::next_endpoint(std::uint32_t column, std::uint32_t row) {
  enum : std::uint32_t { from_left, from_above, from_upper_left, by_difference };
  const std::uint32_t source = predictions_ & 3;
  predictions_ >>= 2;
  const bool is_outside = (source == from_left && column == 0) || (source == from_above && row == 0) ||
                          (source == from_upper_left && (column == 0 || row == 0));
  if (is_outside) throw std::runtime_error("a block repeats one outside of the picture");
  const std::uint32_t above = upper_endpoints_[column];
  std::uint32_t endpoint = left_endpoint_;
  if (source == from_above) endpoint = above;
  if (source == from_upper_left) endpoint = upper_left_endpoint_;
  if (source == by_difference) {
    // The block before in the order of reading: at the start of a row, the last one of the row above.
    endpoint += decoder_.endpoint_code_.decode(bits_);
    const auto count = static_cast<std::uint32_t>(decoder_.endpoints_.size());
    if (endpoint >= count) endpoint -= count;
    if (endpoint >= count) throw std::runtime_error("a block names an endpoint that is not there");
  }
  upper_left_endpoint_ = above;
  upper_endpoints_[column] = static_cast<std::uint16_t>(endpoint);
  return left_endpoint_ = endpoint;
}

std::uint32_t Etc1sDecoder::SliceReader::next_selector() {
  constexpr std::uint32_t longest_run = 63, shortest_run = 3;
  const auto count = static_cast<std::uint32_t>(decoder_.selectors_.size());
  const std::uint32_t run_symbol = count + decoder_.recent_count_;
  if (selector_repeats_ > 0) {
    --selector_repeats_;
    return recent_selector(0);
  }
  const std::uint32_t symbol = decoder_.selector_code_.decode(bits_);
  if (symbol < count) {
    if (!recent_.empty()) {
      recent_[recent_end_++] = static_cast<std::uint16_t>(symbol);
      if (recent_end_ == recent_.size()) recent_end_ = static_cast<std::uint32_t>(recent_.size() / 2);
    }
    return symbol;
  }
  if (symbol > run_symbol) throw std::runtime_error("a block names a selector that is not there");
  if (symbol < run_symbol) return recent_selector(symbol - count);
  const std::uint32_t run = decoder_.repeat_code_.decode(bits_);
  if (run > longest_run) throw std::runtime_error("a run of selectors is out of range");
  const std::uint32_t length = run == longest_run ? std::min(bits_.read_variable(7), ~0u - shortest_run) : run;
  selector_repeats_ = length + shortest_run - 1;
  return recent_selector(0);
}

/// A selector that is used again moves half way to the front.
std::uint32_t Etc1sDecoder::SliceReader::recent_selector(std::uint32_t index) {
  if (index >= recent_.size()) throw std::runtime_error("a block repeats a selector that is not there");
  const std::uint32_t selector = recent_[index];
  std::swap(recent_[index], recent_[index / 2]);
  return selector;
}

}  // namespace candil
