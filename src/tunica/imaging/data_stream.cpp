#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "tunica/base/error.hpp"
#include "tunica/imaging/voxel_data.hpp"

namespace tunica::imaging {

namespace {

constexpr int zlib_or_gzip = 15 + 32;       // window bits, and the sign that zlib finds out which of them it is
constexpr std::int64_t most_packed = 1032;  // the highest ratio of deflate (zlib.net/zlib_tech.html)

bool begins_like_gzip(const unsigned char* bytes, std::size_t count) {
  return count >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
}

}  // namespace

struct DataStream::State {
  std::filesystem::path path;
  std::ifstream file;
  std::int64_t left = 0;  ///< bytes of the file that have not been taken from it
  bool deflated = false, inflating = false;
  bool at_member_end = false;  ///< one member is complete, and another one may follow
  bool at_end = false;
  z_stream zlib{};
  std::array<unsigned char, 1 << 16> buffer;

  ~State() {
    if (inflating) inflateEnd(&zlib);
  }

  std::size_t take(void* to, std::size_t bytes) {
    const auto wanted = static_cast<std::streamsize>(std::min<std::int64_t>(left, static_cast<std::int64_t>(bytes)));
    file.read(static_cast<char*>(to), wanted);
    const auto got = file.gcount();
    if (got < wanted) throw InputError(path.string(), "cannot be read to its end", "copy the file again");
    left -= got;
    return static_cast<std::size_t>(got);
  }

  /// Compressed bytes after those that wait in the buffer.
  void refill() {
    std::copy(zlib.next_in, zlib.next_in + zlib.avail_in, buffer.data());
    zlib.avail_in += static_cast<uInt>(take(buffer.data() + zlib.avail_in, buffer.size() - zlib.avail_in));
    zlib.next_in = buffer.data();
  }

  /// After a member: true when another one follows. What is not a member is left alone, as gzip does.
  bool next_member() {
    if (zlib.avail_in < 2 && left > 0) refill();
    at_member_end = false;
    at_end = !begins_like_gzip(zlib.next_in, zlib.avail_in);
    if (!at_end) inflateReset(&zlib);
    return !at_end;
  }

  std::size_t inflate_to(char* to, std::size_t bytes) {
    zlib.next_out = reinterpret_cast<Bytef*>(to);
    zlib.avail_out = static_cast<uInt>(bytes);
    while (zlib.avail_out > 0 && !at_end) {
      if (at_member_end && !next_member()) break;
      if (zlib.avail_in == 0 && left > 0) refill();
      const int state = inflate(&zlib, Z_NO_FLUSH);
      at_member_end = state == Z_STREAM_END;
      if (state == Z_OK || at_member_end) continue;
      const bool cut = state == Z_BUF_ERROR && left == 0;
      throw InputError(path.string(),
                       cut ? "its compressed data end too early"
                           : fmt::format("its compressed data are damaged ({})", zlib.msg ? zlib.msg : "by zlib"),
                       cut ? "copy the file again, it seems to be cut off" : "copy or write the image again");
    }
    return bytes - zlib.avail_out;
  }
};

DataStream::DataStream(const DataPlace& place, Packing packing) : state_(std::make_unique<State>()) {
  auto& s = *state_;
  s.path = place.file;
  std::error_code error;
  if (!std::filesystem::is_regular_file(place.file, error))
    throw InputError(place.file.string(), "there is no such file, and the image needs it for its data",
                     "copy it to where the header of the image says");
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(place.file));
  s.file.open(place.file, std::ios::binary);
  if (!s.file) throw InputError(place.file.string(), "cannot be opened", "check its permissions");
  if (place.offset > size)
    throw InputError(place.file.string(),
                     fmt::format("its data begin after {} bytes, the file has {}", place.offset, size),
                     "copy the file again, it seems to be cut off");
  s.file.seekg(place.offset);
  s.left = std::min(size - place.offset, place.bytes);
  s.deflated = packing == Packing::deflated;
  if (packing == Packing::detected) {
    unsigned char first[2] = {};
    s.file.read(reinterpret_cast<char*>(first), std::min<std::int64_t>(2, s.left));
    s.deflated = begins_like_gzip(first, static_cast<std::size_t>(s.file.gcount()));
    s.file.seekg(place.offset);
  }
  if (!s.deflated) return;
  s.zlib.next_in = s.buffer.data();
  s.inflating = inflateInit2(&s.zlib, zlib_or_gzip) == Z_OK;
  if (!s.inflating) throw SolverError("zlib cannot be started: there is no memory left");
}

DataStream::~DataStream() = default;

std::size_t DataStream::read(char* to, std::size_t bytes) {
  constexpr std::size_t block = std::size_t{1} << 30;  // zlib counts with 32 bits
  std::size_t done = 0;
  while (done < bytes) {
    const auto part = std::min(block, bytes - done);
    const auto got = state_->deflated ? state_->inflate_to(to + done, part) : state_->take(to + done, part);
    done += got;
    if (got < part) break;
  }
  return done;
}

std::int64_t DataStream::skip(std::int64_t bytes) {
  std::array<char, 1 << 14> away;
  std::int64_t done = 0;
  while (done < bytes) {
    const auto part = std::min<std::int64_t>(bytes - done, away.size());
    const auto got = static_cast<std::int64_t>(read(away.data(), static_cast<std::size_t>(part)));
    done += got;
    if (got < part) break;
  }
  return done;
}

std::int64_t DataStream::most() const {
  const auto& s = *state_;
  if (!s.deflated) return s.left;
  const auto packed = s.left + s.zlib.avail_in;
  // A kilobyte for what zlib has taken in and not yet given out.
  const auto limit = std::numeric_limits<std::int64_t>::max() / most_packed - 1024;
  return most_packed * (std::min(packed, limit) + 1024);
}

bool DataStream::deflated() const { return state_->deflated; }

std::string compressed(const std::string& bytes, bool gzip) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, 15 + (gzip ? 16 : 0), 8, Z_DEFAULT_STRATEGY);
  std::string result;
  std::array<char, 1 << 16> block;
  std::size_t given = 0;
  for (int state = Z_OK; state != Z_STREAM_END;) {
    if (stream.avail_in == 0) {  // zlib counts with 32 bits
      const auto part = std::min<std::size_t>(bytes.size() - given, std::size_t{1} << 30);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + given));
      stream.avail_in = static_cast<uInt>(part);
      given += part;
    }
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = static_cast<uInt>(block.size());
    state = deflate(&stream, given == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
    result.append(block.data(), block.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  return result;
}

}  // namespace tunica::imaging
