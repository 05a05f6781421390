// SPDX-License-Identifier: GPL-3.0-or-later
// operator new of this test program, which counts; in a file of its own, so that no caller sees it
// is malloc.
#include <atomic>
#include <cstdlib>
#include <new>

long count_of_allocations();

namespace {
std::atomic<long> allocations = 0;
}

// Replaced for the whole test program, to count. Aligned forms included: they are what grids use.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto unit = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(unit, (size + unit - 1) / unit * unit)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

long count_of_allocations() { return allocations; }
