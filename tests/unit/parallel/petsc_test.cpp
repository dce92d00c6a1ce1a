#include "tunica/parallel/petsc.hpp"

#include <gtest/gtest.h>

#include "tunica/base/error.hpp"

namespace tunica::parallel {
namespace {

VecHandle make_vector(PetscInt entries) {
  VecHandle x;
  check(VecCreateMPI(MPI_COMM_WORLD, PETSC_DECIDE, entries, x.out()));
  return x;
}

PetscInt references(Vec x) {
  PetscInt count = 0;
  check(PetscObjectGetReference(reinterpret_cast<PetscObject>(x), &count));
  return count;
}

TEST(Handle, DestroysItsObjectOnce) {
  VecHandle kept = make_vector(10);
  check(PetscObjectReference(reinterpret_cast<PetscObject>(kept.get())));  // a second owner, to look at afterwards
  const Vec raw = kept;
  EXPECT_EQ(references(raw), 2);
  {
    const VecHandle moved = std::move(kept);
    EXPECT_EQ(moved.get(), raw);
    EXPECT_EQ(kept.get(), nullptr);
    EXPECT_EQ(references(raw), 2);
  }
  EXPECT_EQ(references(raw), 1);
  VecHandle second_owner(raw);
  second_owner.reset();
  EXPECT_EQ(second_owner.get(), nullptr);
}

TEST(Handle, DestroysWhatItHeldOnAssignmentAndReuse) {
  VecHandle x = make_vector(4);
  check(PetscObjectReference(reinterpret_cast<PetscObject>(x.get())));
  VecHandle watch(x.get());
  x = make_vector(6);
  EXPECT_EQ(references(watch), 1);
  check(PetscObjectReference(reinterpret_cast<PetscObject>(x.get())));
  VecHandle watch_second(x.get());
  check(VecDuplicate(watch, x.out()));
  EXPECT_EQ(references(watch_second), 1);
}

TEST(Check, TurnsAnErrorIntoASolverErrorThatSaysWhat) {
  const VecHandle x = make_vector(10), y = make_vector(11);
  try {
    check(VecAXPY(x, 1.0, y));
    FAIL() << "no error";
  } catch (const SolverError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("petsc_test.cpp"), std::string::npos) << text;
    EXPECT_NE(text.find("10"), std::string::npos) << text;
    EXPECT_NE(text.find("11"), std::string::npos) << text;
  }
}

TEST(Session, IgnoresOptionsFromOutside) {
  PetscBool found = PETSC_TRUE;
  check(PetscOptionsHasName(nullptr, nullptr, "-options_from_outside", &found));
  EXPECT_EQ(found, PETSC_FALSE);
  check(PetscOptionsHasName(nullptr, nullptr, "-skip_petscrc", &found));
  EXPECT_EQ(found, PETSC_TRUE);
}

}  // namespace
}  // namespace tunica::parallel
