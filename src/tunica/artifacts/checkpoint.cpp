#include "tunica/artifacts/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tunica/artifacts/start_file.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/atomic_file.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/parallel/agree.hpp"
#include "tunica/parallel/gather.hpp"

namespace tunica::artifacts {

namespace fs = std::filesystem;

namespace {

// magic | version | length of the header | header (JSON) | fields | hash of header and fields. Little endian.
constexpr char magic[8] = {'t', 'u', 'n', 'i', 'c', 'a', 'C', 'P'};
// Version 1 has no end pressures.
constexpr std::uint64_t newest_version = 2;
constexpr std::uint64_t longest_header = 1 << 24;

struct NodalField {
  std::vector<double> coupling::State::*values;
  int components;
};

/// In the order of the file.
std::vector<NodalField> nodal_fields(std::uint64_t of_version) {
  using coupling::State;
  std::vector<NodalField> fields{{&State::velocity_pressure, 4},
                                 {&State::acceleration, 4},
                                 {&State::displacement, 4},
                                 {&State::displacement_rate, 4}};
  if (of_version > 1) fields.push_back({&State::end_pressure, 1});
  return fields;
}

std::uint64_t bytes_of_node(std::uint64_t of_version) {
  std::uint64_t numbers = 0;
  for (const auto& field : nodal_fields(of_version)) numbers += static_cast<std::uint64_t>(field.components);
  return numbers * sizeof(double);
}

parallel::NodeOrder node_order(const distributed::DistributedMesh& mesh) {
  return {mesh.comm, std::span(mesh.original_ids).first(static_cast<std::size_t>(mesh.owned_nodes)), mesh.global_nodes};
}

nlohmann::json header_of(const Checkpoint& c, std::int64_t nodes) {
  nlohmann::json outlets = nlohmann::json::array();
  for (const auto& outlet : c.state.outlets)
    outlets.push_back({{"face", outlet.face()}, {"state", outlet.state()}, {"pressure", outlet.pressure()}});
  const auto& p = c.position;
  return {{"nodes", nodes},
          {"case_hash", c.case_hash},
          {"mesh_hash", c.mesh_hash},
          {"step", c.state.step},
          {"time", c.state.time},
          {"dt", c.state.dt},
          {"residual_reference", c.state.residual_reference},
          {"velocity_reference", c.state.velocity_reference},
          {"tear_flow_reference", c.state.tear_flow_reference},
          {"outlets", outlets},
          {"grid",
           {{"base_time", p.base_time},
            {"base_step", p.base_step},
            {"nominal", p.nominal},
            {"done", p.done},
            {"part", p.part},
            {"level", p.level}}}};
}

void restore_outlets(const nlohmann::json& saved, std::vector<bc::Outlet>& outlets, const std::string& where) {
  if (saved.size() != outlets.size())
    throw InputError(where, fmt::format("has {} outlets, the case has {}", saved.size(), outlets.size()),
                     "restart with the case that wrote the checkpoint");
  for (std::size_t k = 0; k < outlets.size(); ++k) {
    if (saved[k].at("face") != outlets[k].face())
      throw InputError(where,
                       fmt::format("outlet {} is {}, in the case it is {}", k + 1,
                                   saved[k].at("face").get<std::string>(), outlets[k].face()),
                       "restart with the case that wrote the checkpoint");
    outlets[k].restore(saved[k].at("state").get<std::vector<double>>());
  }
}

void take_header(const nlohmann::json& h, Checkpoint& c, const std::string& where) {
  c.case_hash = h.at("case_hash");
  c.mesh_hash = h.at("mesh_hash");
  c.state.step = h.at("step");
  c.state.time = h.at("time");
  c.state.dt = h.at("dt");
  c.state.residual_reference = h.at("residual_reference");
  c.state.velocity_reference = h.value("velocity_reference", 0.0);    // older ones had no adaptive steps
  c.state.tear_flow_reference = h.value("tear_flow_reference", 0.0);  // and did not look at the balance
  const nlohmann::json& g = h.at("grid");
  c.position = {g.at("base_time"), g.at("base_step"), g.at("nominal"), g.at("done"), g.at("part"), g.at("level")};
  restore_outlets(h.at("outlets"), c.state.outlets, where);
}

[[noreturn]] void damaged(const fs::path& file, const std::string& what) {
  throw InputError(file.string(), what, "use another checkpoint");
}

/// Reading end of a checkpoint, on rank 0.
class Reader {
 public:
  explicit Reader(const fs::path& file) : file_(file), stream_(file, std::ios::binary) {
    if (!stream_) damaged(file, fmt::format("cannot be opened ({})", std::strerror(errno)));
  }
  void read(void* to, std::size_t bytes) {
    stream_.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    if (!stream_) damaged(file_, "the checkpoint is not complete");
    hash_.add(to, bytes);
  }
  std::string header() {
    char found[8];
    std::uint64_t length = 0;
    read(found, sizeof found);
    if (std::memcmp(found, magic, sizeof magic) != 0) damaged(file_, "is no tunica checkpoint");
    read(&version_, sizeof version_);
    if (version_ < 1 || version_ > newest_version)
      damaged(file_, fmt::format("has format version {}, this tunica reads version {} and earlier ones", version_,
                                 newest_version));
    read(&length, sizeof length);
    if (length > longest_header) damaged(file_, "the checkpoint is damaged");
    std::string text(length, '\0');
    read(text.data(), length);
    return text;
  }
  /// Of the format, once the header is read.
  std::uint64_t format_version() const { return version_; }
  void finish() {
    const std::uint64_t expected = hash_.value();
    std::uint64_t found = 0;
    read(&found, sizeof found);
    if (found != expected) damaged(file_, "the checkpoint is damaged: its contents do not have the recorded hash");
    if (stream_.peek() != std::ifstream::traits_type::eof())
      damaged(file_, "the checkpoint is damaged: it goes on after its end");
  }

 private:
  fs::path file_;
  std::ifstream stream_;
  files::Hash hash_;
  std::uint64_t version_ = 0;
};

class Writer {
 public:
  explicit Writer(const fs::path& file) : file_(file) {}
  void write(const void* data, std::size_t bytes) {
    file_.write(data, bytes);
    hash_.add(data, bytes);
  }
  void header(const std::string& text) {
    const std::uint64_t length = text.size();
    write(magic, sizeof magic);
    write(&newest_version, sizeof newest_version);
    write(&length, sizeof length);
    write(text.data(), text.size());
  }
  void finish() {
    const std::uint64_t hash = hash_.value();
    write(&hash, sizeof hash);
    file_.finish();
  }

 private:
  files::AtomicFile file_;
  files::Hash hash_;
};

}  // namespace

void write_checkpoint(const fs::path& file, const distributed::DistributedMesh& mesh, const Checkpoint& checkpoint) {
  std::optional<Writer> writer;
  parallel::on_root(mesh.comm, [&] {
    std::error_code exists_or_fails_below;
    fs::create_directories(file.parent_path(), exists_or_fails_below);
    writer.emplace(file);
    writer->header(header_of(checkpoint, mesh.global_nodes).dump());
  });
  for (const auto& field : nodal_fields(newest_version)) {
    const auto values =
        parallel::gather_by_original_id(node_order(mesh), checkpoint.state.*field.values, field.components);
    parallel::on_root(mesh.comm, [&] { writer->write(values.data(), values.size() * sizeof(double)); });
  }
  parallel::on_root(mesh.comm, [&] { writer->finish(); });
}

void write_start(const fs::path& file, const coupling::State& state, std::uint64_t mesh_hash) {
  Checkpoint checkpoint{.state = state, .position = {}, .mesh_hash = mesh_hash};
  Writer writer(file);
  writer.header(header_of(checkpoint, std::ssize(state.end_pressure)).dump());
  for (const auto& field : nodal_fields(newest_version)) {
    const auto& values = state.*field.values;
    writer.write(values.data(), values.size() * sizeof(double));
  }
  writer.finish();
}

std::string damage_of(const fs::path& file) {
  try {
    Reader reader(file);
    const nlohmann::json header = nlohmann::json::parse(reader.header(), nullptr, false);
    if (header.is_discarded() || !header.is_object() || !header.contains("nodes") ||
        !header["nodes"].is_number_unsigned())
      return "the header is damaged";
    std::vector<char> block(1 << 16);
    const std::uint64_t of_node = bytes_of_node(reader.format_version());
    const std::uint64_t nodes = header["nodes"], size = fs::file_size(file);
    if (nodes > size / of_node) return "the checkpoint is not complete";
    for (std::uint64_t left = nodes * of_node; left > 0;) {
      const std::uint64_t part = std::min<std::uint64_t>(left, block.size());
      reader.read(block.data(), part);
      left -= part;
    }
    reader.finish();
    return "";
  } catch (const InputError& error) {
    return error.problems().front().what;
  } catch (const fs::filesystem_error& error) {
    return error.code().message();
  }
}

namespace {

/// Reads header and nodal fields. `take(header)` is called on all ranks. Returns whether the end pressures stood there;
/// where not, those of the last step stand for them.
template <class Take>
bool read(const fs::path& file, const distributed::DistributedMesh& mesh, std::uint64_t mesh_hash,
          coupling::State& state, const std::string& remedy, const Take& take) {
  std::optional<Reader> reader;
  std::string header = parallel::on_root(mesh.comm, [&] {
    if (const std::string damage = damage_of(file); !damage.empty()) throw InputError(file.string(), damage, remedy);
    reader.emplace(file);
    std::string text = reader->header();
    const nlohmann::json h = nlohmann::json::parse(text, nullptr, false);
    if (h.is_discarded() || !h.contains("mesh_hash") || !h.contains("nodes")) damaged(file, "the header is damaged");
    if (h["mesh_hash"] != mesh_hash || h["nodes"] != mesh.global_nodes)
      throw InputError(file.string(), "the checkpoint belongs to another mesh than the case",
                       "restart with the case and the mesh files that wrote it");
    return text;
  });
  parallel::broadcast(mesh.comm, header);
  std::uint64_t of_version = reader ? reader->format_version() : 0;
  parallel::broadcast(mesh.comm, of_version);
  parallel::agree(mesh.comm, [&] {
    try {
      take(nlohmann::json::parse(header));
    } catch (const nlohmann::json::exception& error) {
      damaged(file, fmt::format("the header is damaged: {}", error.what()));
    }
  });
  const bool root = parallel::rank(mesh.comm) == 0;
  std::vector<double> field;
  for (const auto& [member, components] : nodal_fields(of_version)) {
    field.resize(root ? static_cast<std::size_t>(components * mesh.global_nodes) : 0);
    parallel::on_root(mesh.comm, [&] { reader->read(field.data(), field.size() * sizeof(double)); });
    auto& values = state.*member;
    parallel::scatter_by_original_id(node_order(mesh), field, values, components);
    mesh.halo.update(values, components);
  }
  parallel::on_root(mesh.comm, [&] { reader->finish(); });
  if (of_version > 1) return true;
  for (std::size_t i = 0; i < state.end_pressure.size(); ++i)
    state.end_pressure[i] = state.velocity_pressure[4 * i + 3];
  return false;
}

}  // namespace

Checkpoint read_checkpoint(const fs::path& file, const distributed::DistributedMesh& mesh, const coupling::State& start,
                           std::uint64_t mesh_hash, const std::string& remedy) {
  Checkpoint c{.state = start, .position = {}};
  c.has_end_pressure = read(file, mesh, mesh_hash, c.state, remedy,
                            [&](const nlohmann::json& header) { take_header(header, c, file.string()); });
  return c;
}

std::vector<OutletStart> read_start(const fs::path& file, const distributed::DistributedMesh& mesh,
                                    coupling::State& state, std::uint64_t mesh_hash, const std::string& remedy) {
  std::vector<OutletStart> outlets;
  read(file, mesh, mesh_hash, state, remedy, [&](const nlohmann::json& header) {
    for (const auto& outlet : header.at("outlets"))
      outlets.push_back({outlet.at("face"), outlet.at("state").at(0), outlet.at("pressure")});
  });
  return outlets;
}

fs::path checkpoint_file(const fs::path& folder, std::int64_t step) {
  return folder / fmt::format("step_{:08}.checkpoint", step);
}

std::int64_t step_of(const fs::path& file) {
  const std::string name = file.filename().string();
  std::int64_t step = -1;
  if (file.extension() != ".checkpoint" || !name.starts_with("step_")) return -1;
  const auto [end, error] = std::from_chars(name.data() + 5, name.data() + name.size(), step);
  return error == std::errc{} && std::string_view(end) == ".checkpoint" ? step : -1;
}

std::vector<fs::path> list_checkpoints(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none))
    if (step_of(entry.path()) >= 0) files.push_back(entry.path());
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return step_of(a) < step_of(b); });
  return files;
}

SoundCheckpoint last_sound_checkpoint(const fs::path& folder) {
  SoundCheckpoint sound;
  const auto files = list_checkpoints(folder);
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    const std::string damage = damage_of(*file);
    if (damage.empty()) {
      sound.file = *file;
      break;
    }
    sound.passed_over.push_back(fmt::format("{}: {}", file->string(), damage));
  }
  return sound;
}

}  // namespace tunica::artifacts
