#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace aeolian {

/// Memory for large fields, in few large pages where the system has them: neighbours along the wind lie a
/// page apart. What is given back is kept, up to a limit, for the next run: fresh pages cost as much as
/// several steps.
void* take_pages(std::size_t bytes);
void give_pages(void* memory, std::size_t bytes);

template <class T>
struct LargePages {
  using value_type = T;
  LargePages() = default;
  template <class U>
  explicit LargePages(const LargePages<U>&) {}
  T* allocate(std::size_t count) { return static_cast<T*>(take_pages(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) { give_pages(memory, count * sizeof(T)); }
  /// Values that nothing is said of are not set.
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }
  friend bool operator==(const LargePages&, const LargePages&) { return true; }
  friend bool operator!=(const LargePages&, const LargePages&) { return false; }
};

/// Values of the cells of a wind frame, station by station: the rows of a station lie side by side, so that
/// one instruction works on several lines along the wind at once. Each station has `pad` values more before
/// and behind.
class FrameField {
 public:
  static constexpr int pad = 8;

  FrameField() = default;
  FrameField(int stations, int rows)
      : rows_(rows), stride_(stride_of(rows)), values_(static_cast<std::size_t>(stations) * stride_, 0.0) {}

  /// The same, of values that are yet to be set.
  static FrameField unset(int stations, int rows) {
    FrameField field;
    field.rows_ = rows;
    field.stride_ = stride_of(rows);
    field.values_.resize(static_cast<std::size_t>(stations) * field.stride_);
    return field;
  }

  /// Row 0 of a station.
  double* at(int station) { return values_.data() + static_cast<std::size_t>(station) * stride_ + pad; }
  const double* at(int station) const {
    return values_.data() + static_cast<std::size_t>(station) * stride_ + pad;
  }
  int rows() const { return rows_; }
  /// Distance of a row's values at neighbouring stations.
  std::ptrdiff_t stride() const { return static_cast<std::ptrdiff_t>(stride_); }

  /// Fills the pads of a station: with the rows beyond a periodic border, or with the outermost row.
  void fill_pads(int station, bool periodic) {
    double* const row = at(station);
    for (int k = 0; k < pad; ++k) {
      row[-1 - k] = row[periodic ? rows_ - 1 - k % rows_ : 0];
      row[rows_ + k] = row[periodic ? k % rows_ : rows_ - 1];
    }
  }

  /// Fills the pads of a station so that an open border is a mirror.
  void fill_mirrored_pads(int station, bool periodic) {
    if (periodic) return fill_pads(station, true);
    double* const row = at(station);
    for (int k = 0; k < pad; ++k) {
      const int image = k % (2 * rows_);
      const double value = row[image < rows_ ? image : 2 * rows_ - 1 - image];
      row[-1 - k] = value;
      row[rows_ + k] = row[image < rows_ ? rows_ - 1 - image : image - rows_];
    }
  }

  void swap(FrameField& other) {
    std::swap(rows_, other.rows_);
    std::swap(stride_, other.stride_);
    values_.swap(other.values_);
  }

 private:
  /// A multiple of 8, but not of 512: stations would share cache sets.
  static std::size_t stride_of(int rows) {
    const std::size_t stride = (static_cast<std::size_t>(rows) + 2 * std::size_t{pad} + 7) / 8 * 8;
    return stride % 512 == 0 ? stride + 8 : stride;
  }

  int rows_ = 0;
  std::size_t stride_ = 0;
  std::vector<double, LargePages<double>> values_;
};

}  // namespace aeolian
