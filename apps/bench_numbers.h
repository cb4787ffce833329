/// Quantities in the units that people read.
#pragma once

#include <cstdint>
#include <string>

namespace candil {

std::string with_thousands(std::uint64_t count);  ///< "1,234,567".
std::string in_seconds(double seconds);           ///< "12.3 ms", "4.56 s".
std::string in_bytes(double bytes);               ///< "512 B", "1.23 MB"; a megabyte is 10^6 bytes.
std::string in_millions(double rate);             ///< "12.3": three digits.

}  // namespace candil
