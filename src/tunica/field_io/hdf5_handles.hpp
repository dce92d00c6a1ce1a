// Handles of HDF5 that close themselves, and failures as exceptions. For the sources of this room only.
#pragma once

#include <hdf5.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace tunica::field_io {

/// What HDF5 could not do; the caller knows the file.
struct Hdf5Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline hid_t checked(hid_t id, const std::string& what) {
  if (id < 0) throw Hdf5Failure(what);
  return id;
}

/// Owns one handle.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(checked(id, what)), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  operator hid_t() const { return id_; }  // NOLINT: as HDF5 takes it

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

/// HDF5 prints what fails; while this lives it does not, and a host program finds its own setting again.
class Silence {
 public:
  Silence() {
    // After a damaged file HDF5 1.10 does not find its end when a program ends, and says so. Files are closed by then.
    [[maybe_unused]] static const herr_t no_end = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

}  // namespace tunica::field_io
