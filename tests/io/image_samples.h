/// Small encoded images for tests, made by hand so that every stored value is known.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace candil::test {

std::vector<std::byte> from_base64(std::string_view text);

/// 2 x 1 RGBA: (200, 100, 50, 128), (10, 20, 30, 0).
inline constexpr std::string_view png_rgba8 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAEUlEQVR42mM4kWLUwCUixwAADVECG8+ovCsAAAAASUVORK5CYII=";
/// 2 x 1 grey: 7, 250.
inline constexpr std::string_view png_grey8 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR42mNg/wUAAQsBAlT5jMQAAAAASUVORK5CYII=";
/// 2 x 1 grey and alpha: (200, 64), (10, 255).
inline constexpr std::string_view png_grey_alpha8 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAQAAABeK7cBAAAADUlEQVR42mM44cD1HwAE+AISwI7fMQAAAABJRU5ErkJggg==";
/// 1 x 1 RGB of 16 bits: 65535, 32768, 1.
inline constexpr std::string_view png_rgb16 =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAIAAADA54+dAAAAD0lEQVR42mP4/7+BgYERAAz9AoA1Gq+qAAAAAElFTkSuQmCC";
/// 2 x 1 indices 1, 0 into (1, 2, 3), (250, 128, 4).
inline constexpr std::string_view png_palette =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAMAAADD/"
    "I+4AAAABlBMVEUBAgP6gASC8zywAAAAC0lEQVR42mNgZAAAAAUAAkLCRJ8AAAAASUVORK5CYII=";
/// 8 x 1 of one bit: 1 0 1 0 0 0 0 0.
inline constexpr std::string_view png_grey1 =
    "iVBORw0KGgoAAAANSUhEUgAAAAgAAAABAQAAAADLe9LuAAAACklEQVR42mNYAAAAogChcQXLQQAAAABJRU5ErkJggg==";
/// 1 x 1 RGB (128, 64, 32) with a gAMA chunk that says the values are linear.
inline constexpr std::string_view png_with_gamma =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAABGdBTUEAAYagMeiWXwAAAAxJREFUeNpjaHBQAAACJADhlaSxiwAAAABJRU5ErkJggg"
    "==";
/// A header of 16384 x 16384 RGBA with a hundred bytes of pixels.
inline constexpr std::string_view png_bomb =
    "iVBORw0KGgoAAAANSUhEUgAAQAAAAEAACAYAAACpyBCEAAAADElEQVR4nGNgoD0AAABkAAGGZDw1AAAAAElFTkSuQmCC";
/// A header of 16385 x 1.
inline constexpr std::string_view png_too_wide =
    "iVBORw0KGgoAAAANSUhEUgAAQAEAAAABCAYAAADJXd1mAAAADElEQVR4nGNgoD0AAABkAAGGZDw1AAAAAElFTkSuQmCC";
/// 8 x 8 of ink.
inline constexpr std::string_view jpeg_cmyk =
    "/9j/7gAOQWRvYmUAZAAAAAAC/"
    "9sAQwADAgICAgIDAgICAwMDAwQGBAQEBAQIBgYFBgkICgoJCAkJCgwPDAoLDgsJCQ0RDQ4PEBAREAoMEhMSEBMPEBAQ/9sA"
    "QwEDAwMEAwQIBAQIEAsJCxAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQ/"
    "8AAFAgACAAIBAERAAIRAQMRAQQR"
    "AP/EABUAAQEAAAAAAAAAAAAAAAAAAAQI/8QAFBABAAAAAAAAAAAAAAAAAAAAAP/EABQBAQAAAAAAAAAAAAAAAAAAAAj/"
    "xAAUEQEAAAAAAAAAAAAAAAAAAAAA"
    "/9oADgQBAAIRAxEEAAA/ACDkE66H/9k=";
/// 2 x 1 RGBA, lossless: (200, 100, 50, 127), (10, 20, 30, 255).
inline constexpr std::string_view webp_rgba8 = "UklGRiIAAABXRUJQVlA4TBYAAAAvAQAAEA9wCqgr+J7C44D/wYOM6H8A";

}  // namespace candil::test
