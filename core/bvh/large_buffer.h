/// Memory of hierarchies.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace candil {

/// An array of plain data that is not initialised, aligned to cache lines. Large ones ask the system for large pages:
/// rays jump about in them, and of pages of 4 kB the processor remembers too few.
template <typename T>
class LargeBuffer {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  LargeBuffer() = default;
  explicit LargeBuffer(std::size_t size) : size_(size) {
    constexpr std::size_t cache_line = 64, large_page = std::size_t{1} << 21;
    if (size > (std::size_t{1} << 48) / sizeof(T)) throw std::bad_alloc();
    const std::size_t alignment = size * sizeof(T) >= large_page ? large_page : cache_line;
    const std::size_t bytes = (size * sizeof(T) + alignment - 1) / alignment * alignment;
    data_.reset(static_cast<T*>(std::aligned_alloc(alignment, bytes > 0 ? bytes : alignment)));
    if (!data_) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    if (alignment == large_page) madvise(data_.get(), bytes, MADV_HUGEPAGE);  // a wish: failing does no harm
#endif
  }
  T* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { return size_ * sizeof(T); }
  T& operator[](std::size_t i) const { return data_.get()[i]; }
  T* begin() const { return data(); }
  T* end() const { return data() + size_; }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };
  std::unique_ptr<T, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace candil
