#include "tunica/artifacts/checkpoint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "shared_folder.hpp"
#include "tunica/base/error.hpp"
#include "tunica/files/hash.hpp"
#include "tunica/mesh/generate.hpp"

namespace tunica::artifacts {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::SharedFolder;
using test::slurp;

/// Values that tell node and component, the same on any number of ranks.
Checkpoint sample(const distributed::DistributedMesh& mesh) {
  Checkpoint c{.state = {},
               .position = {.base_time = 0.1, .base_step = 2, .nominal = 1.0 / 3, .done = 7, .part = 5, .level = 2},
               .case_hash = 0xfedcba9876543210ULL,
               .mesh_hash = 42};
  auto& s = c.state;
  s.step = 19;
  s.time = 0.1 + 0.2;
  s.dt = 1.0 / 7;
  s.residual_reference = 1e-300 / 3;
  int shift = 0;
  for (auto* field : {&s.velocity_pressure, &s.acceleration, &s.displacement, &s.displacement_rate}) {
    ++shift;
    for (const auto id : mesh.original_ids)
      for (int k = 0; k < 4; ++k) field->push_back(std::sin(1.0 + 4.0 * static_cast<double>(id) + k + 1e5 * shift));
  }
  for (const auto id : mesh.original_ids) s.end_pressure.push_back(std::cos(1.0 + static_cast<double>(id)));
  s.outlets.emplace_back("z_max", bc::Rcr{.proximal = 1, .capacitance = 2, .distal = 3});
  s.outlets[0].commit(0.1, 0.3);
  return c;
}

coupling::State blank(const Checkpoint& like) {
  coupling::State s;
  for (auto* field : {&s.velocity_pressure, &s.acceleration, &s.displacement, &s.displacement_rate})
    field->assign(like.state.velocity_pressure.size(), 0.0);
  s.end_pressure.assign(like.state.end_pressure.size(), 0.0);
  s.outlets.emplace_back("z_max", bc::Rcr{.proximal = 1, .capacitance = 2, .distal = 3});
  return s;
}

class CheckpointTest : public testing::Test {
 protected:
  SharedFolder folder;
  distributed::DistributedMesh mesh =
      distributed::distribute(mesh::box(3, 2, 4, {{1, 1, 1}}, mesh::RegionKind::lumen), MPI_COMM_WORLD);
  Checkpoint written = sample(mesh);
  fs::path file = folder.path() / "new" / "step_00000007.checkpoint";
};

TEST_F(CheckpointTest, GivesBackEveryBit) {
  write_checkpoint(file, mesh, written);
  const Checkpoint read = read_checkpoint(file, mesh, blank(written), 42, "another");
  const auto &a = written.state, &b = read.state;
  EXPECT_EQ(a.velocity_pressure, b.velocity_pressure);  // ghosts included
  EXPECT_EQ(a.acceleration, b.acceleration);
  EXPECT_EQ(a.displacement, b.displacement);
  EXPECT_EQ(a.displacement_rate, b.displacement_rate);
  EXPECT_EQ(a.end_pressure, b.end_pressure);
  EXPECT_TRUE(read.has_end_pressure);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.dt, b.dt);
  EXPECT_EQ(a.residual_reference, b.residual_reference);
  EXPECT_EQ(a.outlets[0].state(), b.outlets[0].state());
  EXPECT_EQ(read.case_hash, written.case_hash);
  EXPECT_EQ(read.position.base_time, 0.1);
  EXPECT_EQ(read.position.base_step, 2);
  EXPECT_EQ(read.position.nominal, 1.0 / 3);
  EXPECT_EQ(read.position.done, 7);
  EXPECT_EQ(read.position.part, 5);
  EXPECT_EQ(read.position.level, 2);
  EXPECT_FALSE(fs::exists(file.string() + ".partial"));
}

TEST_F(CheckpointTest, DoesNotDependOnTheNumberOfRanks) {
  write_checkpoint(file, mesh, written);
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    const auto alone = distributed::distribute(mesh::box(3, 2, 4, {{1, 1, 1}}, mesh::RegionKind::lumen), MPI_COMM_SELF);
    const fs::path serial = folder.path() / "step_00000008.checkpoint";
    write_checkpoint(serial, alone, sample(alone));
    EXPECT_EQ(slurp(serial), slurp(file));
  }
}

TEST_F(CheckpointTest, RefusesWhatDoesNotFit) {
  write_checkpoint(file, mesh, written);
  const auto refusal = [&](std::uint64_t mesh_hash, const coupling::State& start) {
    return message_of<InputError>([&] { read_checkpoint(file, mesh, start, mesh_hash, "another"); });
  };
  EXPECT_NE(refusal(43, blank(written)).find("belongs to another mesh"), std::string::npos);
  coupling::State other = blank(written);
  other.outlets[0] = bc::Outlet("z_min", bc::Resistance{.resistance = 1});
  EXPECT_NE(refusal(42, other).find("outlet 1 is z_max, in the case it is z_min"), std::string::npos);
  other.outlets.clear();
  EXPECT_NE(refusal(42, other).find("has 1 outlets, the case has 0"), std::string::npos);
}

TEST_F(CheckpointTest, NoticesDamage) {
  write_checkpoint(file, mesh, written);
  const std::string good = slurp(file);
  MPI_Barrier(MPI_COMM_WORLD);
  const auto refusal = [&](const std::string& contents) {
    const auto bad = folder.write("bad.checkpoint", contents);
    return message_of<InputError>([&] { read_checkpoint(bad, mesh, blank(written), 42, "do that instead"); });
  };
  std::string flipped = good;
  flipped[flipped.size() - 100] ^= 1;
  EXPECT_NE(refusal(flipped).find("do not have the recorded hash"), std::string::npos);
  EXPECT_NE(refusal(good.substr(0, good.size() / 2)).find("not complete"), std::string::npos);
  EXPECT_NE(refusal("something else altogether").find("is no tunica checkpoint"), std::string::npos);
  std::string newer = good;
  newer[8] = 3;
  EXPECT_NE(refusal(newer).find("format version 3"), std::string::npos);
  EXPECT_NE(refusal("").find("not complete"), std::string::npos);
  EXPECT_NE(refusal(good + "x").find("goes on after its end"), std::string::npos);
  EXPECT_NE(refusal(flipped).find("do that instead"), std::string::npos);
}

// Version 1 had no pressures at the ends of steps.
TEST_F(CheckpointTest, ReadsTheFirstVersion) {
  write_checkpoint(file, mesh, written);
  if (parallel::rank(MPI_COMM_WORLD) == 0) {
    const std::string now = slurp(file);
    const auto nodes = static_cast<std::size_t>(mesh.global_nodes);
    std::string early = now.substr(0, now.size() - 8 * nodes - 8);
    early[8] = 1;
    std::uint64_t header = 0;
    std::memcpy(&header, early.data() + 16, sizeof header);
    files::Hash hash;
    hash.add(early.data(), 24);
    hash.add(early.data() + 24, header);
    hash.add(early.data() + 24 + header, early.size() - 24 - header);
    const std::uint64_t value = hash.value();
    early.append(reinterpret_cast<const char*>(&value), sizeof value);
    std::ofstream(file, std::ios::binary) << early;
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(damage_of(file), "");
  const Checkpoint read = read_checkpoint(file, mesh, blank(written), 42, "another");
  EXPECT_FALSE(read.has_end_pressure);
  EXPECT_EQ(read.state.displacement_rate, written.state.displacement_rate);
  EXPECT_EQ(read.state.end_pressure[1], written.state.velocity_pressure[4 + 3]);
}

TEST_F(CheckpointTest, EveryBitCounts) {
  write_checkpoint(file, mesh, written);
  if (parallel::rank(MPI_COMM_WORLD) != 0) return;
  EXPECT_EQ(damage_of(file), "");
  const std::string good = slurp(file);
  const auto bad = folder.path() / "bad.checkpoint";
  for (std::size_t k = 0; k < good.size(); k += k < 1200 ? 1 : 97) {
    std::string flipped = good;
    flipped[k] ^= static_cast<char>(1 << (k % 8));
    std::ofstream(bad, std::ios::binary) << flipped;
    EXPECT_NE(damage_of(bad), "") << k;
  }
}

TEST_F(CheckpointTest, TheLastWholeOneIsFound) {
  for (const int step : {1, 2, 3}) write_checkpoint(checkpoint_file(folder.path(), step), mesh, written);
  if (parallel::rank(MPI_COMM_WORLD) != 0) return;
  const auto cut = [&](int step) { fs::resize_file(checkpoint_file(folder.path(), step), 100); };
  EXPECT_EQ(step_of(last_sound_checkpoint(folder.path()).file.value()), 3);
  cut(3);
  const auto found = last_sound_checkpoint(folder.path());
  EXPECT_EQ(step_of(found.file.value()), 2);
  ASSERT_EQ(found.passed_over.size(), 1u);
  EXPECT_NE(found.passed_over[0].find("step_00000003.checkpoint: the checkpoint is not complete"), std::string::npos);
  cut(1), cut(2);
  EXPECT_FALSE(last_sound_checkpoint(folder.path()).file);
  EXPECT_EQ(last_sound_checkpoint(folder.path()).passed_over.size(), 3u);
  EXPECT_FALSE(last_sound_checkpoint(folder.path() / "none").file);
}

TEST(Checkpoints, AreListedInTheOrderOfSteps) {
  const SharedFolder folder(MPI_COMM_SELF);
  EXPECT_TRUE(list_checkpoints(folder.path() / "none").empty());
  for (const char* name : {"step_00000100.checkpoint", "step_00000020.checkpoint", "step_123456789.checkpoint",
                           "step_00000030.checkpoint.partial", "notes.txt"})
    folder.write(name, "");
  const auto files = list_checkpoints(folder.path());
  ASSERT_EQ(files.size(), 3u);
  EXPECT_EQ(step_of(files[0]), 20);
  EXPECT_EQ(step_of(files[2]), 123456789);
  EXPECT_EQ(step_of("step_1x.checkpoint"), -1);
  EXPECT_EQ(checkpoint_file("f", 20).filename(), "step_00000020.checkpoint");
}

}  // namespace
}  // namespace tunica::artifacts
