/*
 * Problem:   checkpoints, whole and broken
 * Reference: the bits that were put in
 */

#include <samara/base/errors.h>
#include <samara/output/checkpoint.h>
#include <samara/output/history.h>

#include <hdf5.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

#include "scratch_folder.h"

using namespace samara;

namespace
{
  /** The bits of numbers: those of nan, and of 0 and -0, differ where the numbers do not. */
  std::vector<std::uint64_t>
  bits(const std::vector<double> &numbers)
  {
    std::vector<std::uint64_t> all(numbers.size());
    for (unsigned int i = 0; i < numbers.size(); ++i)
      std::memcpy(&all[i], &numbers[i], sizeof(double));
    return all;
  }



  double
  from_bits(const std::uint64_t bits)
  {
    double number;
    std::memcpy(&number, &bits, sizeof(number));
    return number;
  }



  Checkpoint
  everything()
  {
    using Limits = std::numeric_limits<double>;
    Checkpoint checkpoint;
    State     &state    = checkpoint.state;
    state.q             = {1. / 3, -0., Limits::denorm_min(), -Limits::max(), Limits::infinity(), Limits::epsilon()};
    state.coordinates   = {from_bits(0x7ff8000000001234u), from_bits(0xfff0000000000001u)}; // two kinds of nan
    state.y             = {};
    state.rates         = {std::sqrt(2.)};
    state.multipliers   = {-1e-300, 1e300};
    state.stress        = std::vector<double>(10000, std::exp(1.));
    state.accelerations = {9.81};
    state.motion.resize(2);
    state.motion[0].spin     = {1, 2, 1. / 7};
    state.motion[1].velocity = {-0., 4, 5};
    state.motion[1].at       = {6, 7, 8};
    state.time               = 0.1 + 0.2;
    state.factor             = std::nextafter(1., 2.);
    state.held               = false;

    checkpoint.step        = std::nextafter(1e-3, 0.);
    checkpoint.numbers     = {{"step / error", Limits::quiet_NaN()}, {"", -0.}, {"γ̇ [1/s]", 1. / 3}, {".", 2}};
    checkpoint.arrays      = {{"a", {}}, {"a/b", {1. / 3, -0.}}, {std::string(1000, 'n'), {1, 2, 3}}};
    checkpoint.model = std::make_shared<const std::string>(std::string(100000, 'f') + std::string("\0\n", 2));
    return checkpoint;
  }



  void
  expect_same(const Checkpoint &a, const Checkpoint &b)
  {
    for (const auto vector : {&State::q,
                              &State::coordinates,
                              &State::y,
                              &State::rates,
                              &State::multipliers,
                              &State::stress,
                              &State::accelerations})
      EXPECT_EQ(bits(a.state.*vector), bits(b.state.*vector));

    ASSERT_EQ(a.state.motion.size(), b.state.motion.size());
    for (unsigned int node = 0; node < a.state.motion.size(); ++node)
      for (const auto vector : {&State::Motion::spin, &State::Motion::velocity, &State::Motion::at})
        for (unsigned int d = 0; d < 3; ++d)
          EXPECT_EQ(bits({(a.state.motion[node].*vector)(d)}), bits({(b.state.motion[node].*vector)(d)}));

    EXPECT_EQ(bits({a.state.time, a.state.factor, a.step}), bits({b.state.time, b.state.factor, b.step}));
    EXPECT_EQ(a.state.held, b.state.held);
    EXPECT_EQ(*a.model, *b.model);

    ASSERT_EQ(a.numbers.size(), b.numbers.size());
    for (const auto &[name, number] : a.numbers)
      EXPECT_EQ(bits({number}), bits({b.numbers.at(name)})) << name;
    ASSERT_EQ(a.arrays.size(), b.arrays.size());
    for (const auto &[name, array] : a.arrays)
      EXPECT_EQ(bits(array), bits(b.arrays.at(name))) << name;
  }



  /** What is said about a checkpoint with this content. */
  std::string
  complaint_about(const std::string &file, const std::string &content)
  {
    std::filesystem::remove(file); // file systems are slow when a file is emptied and filled again
    std::ofstream(file, std::ios::binary) << content;
    try
      {
        read_checkpoint(file);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "no complaint";
  }
} // namespace



TEST(Checkpoint, RoundTripToTheLastBit)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/checkpoint";
  write_checkpoint(file, everything());
  expect_same(read_checkpoint(file), everything());
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));

  write_checkpoint(file, Checkpoint());
  expect_same(read_checkpoint(file), Checkpoint());
}



TEST(Checkpoint, EqualCheckpointsAreEqualFiles)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/checkpoint";
  write_checkpoint(file, everything());
  const std::string first = content_of(file);
  write_checkpoint(file, read_checkpoint(file));
  EXPECT_TRUE(content_of(file) == first);
}



TEST(Checkpoint, ToolsOfHdf5FindTheirWay)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/checkpoint";
  write_checkpoint(file, everything());

  const hid_t         handle  = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t         dataset = H5Dopen2(handle, "state/q", H5P_DEFAULT);
  std::vector<double> q(6);
  EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, q.data()), 0);
  EXPECT_EQ(bits(q), bits(everything().state.q));
  H5Dclose(dataset);
  H5Fclose(handle);
}



TEST(Checkpoint, MissingOneAndFolder)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/checkpoint";
  EXPECT_THROW(read_checkpoint(file), InputError);
  EXPECT_EQ(complaint_of([&] { read_checkpoint(file); }),
            "there is no checkpoint " + file + "; start without --restart.");
  EXPECT_THROW(read_checkpoint(folder.path), InputError);
  EXPECT_TRUE(contains(complaint_of([&] { read_checkpoint(folder.path); }), folder.path + " cannot be read"));
}



TEST(Checkpoint, FilesOfOtherKinds)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/checkpoint";
  const std::string   no   = file + " is not a checkpoint that samara wrote.";
  EXPECT_EQ(complaint_about(file, "# a model"), no);
  EXPECT_EQ(complaint_about(file, std::string(100000, '\0')), no);

  History(folder.path, "h", {{"t", "s"}});
  EXPECT_EQ(complaint_about(file, content_of(folder.path + "/h.h5")), no);

  write_checkpoint(file, everything());
  std::string content                   = content_of(file);
  content[content.find("format ") + 7] = '1';
  EXPECT_TRUE(contains(complaint_about(file, content), "another version of samara"));
}



TEST(Checkpoint, AnyLossAndAnyChangeIsNoticed)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/checkpoint";
  Checkpoint          checkpoint;
  checkpoint.state.q = {1, 2, 3};
  write_checkpoint(file, checkpoint);
  const std::string content = content_of(file);
  const std::string damaged = "the checkpoint " + file + " is damaged";

  for (std::size_t size = 0; size < content.size(); size += size < 600 || size + 20 > content.size() ? 1 : 97)
    EXPECT_TRUE(contains(complaint_about(file, content.substr(0, size)), damaged)) << size;
  EXPECT_TRUE(contains(complaint_about(file, content + "x"), damaged));
  for (std::size_t at = 0; at < content.size(); at += at < 600 ? 1 : 13)
    {
      std::string changed = content;
      changed[at] ^= 16;
      EXPECT_NE(complaint_about(file, changed), "no complaint") << at;
    }
}



TEST(Checkpoint, DiskThatFillsIsNamedAndTheOldOneStays)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/checkpoint";
  write_checkpoint(file, Checkpoint());
  const std::string old = content_of(file);

  for (const unsigned int bytes : {0, 1, 512, 5000, 50000})
    {
      std::string complaint;
      {
        const FileSizeLimit limit(bytes);
        complaint = complaint_of([&] { write_checkpoint(file, everything()); });
      }
      EXPECT_EQ(complaint, "cannot write " + file + ": File too large.") << bytes;
      EXPECT_TRUE(content_of(file) == old) << bytes;
      EXPECT_FALSE(std::filesystem::exists(file + ".part")) << bytes;
    }

  if (!std::filesystem::exists("/dev/full"))
    GTEST_SKIP() << "no /dev/full here";
  make_full(file + ".part");
  EXPECT_EQ(complaint_of([&] { write_checkpoint(file, everything()); }),
            "cannot write " + file + ": No space left on device.");
  EXPECT_TRUE(content_of(file) == old);
  EXPECT_FALSE(std::filesystem::is_symlink(file + ".part"));
}



TEST(Checkpoint, PlaceThatCannotBeWrittenIsNamed)
{
  const ScratchFolder folder;
  const std::string   nowhere = folder.path + "/nowhere/checkpoint", taken = folder.path + "/taken";
  EXPECT_TRUE(contains(complaint_of([&] { write_checkpoint(nowhere, Checkpoint()); }), "cannot write " + nowhere));

  std::filesystem::create_directories(taken + "/by another");
  EXPECT_EQ(complaint_of([&] { write_checkpoint(taken, Checkpoint()); }),
            "cannot write " + taken + ": Is a directory.");
  EXPECT_FALSE(std::filesystem::exists(taken + ".part"));
}



/** Whenever the program is killed, the last checkpoint or the one before is there. */
TEST(Checkpoint, KilledProcessLeavesAWholeOne)
{
  const ScratchFolder folder;
  const std::string   file = folder.path + "/checkpoint";
  Checkpoint          checkpoint;
  checkpoint.state.q.resize(100000);
  write_checkpoint(file, checkpoint);
  for (unsigned int kill = 0; kill < 10; ++kill)
    {
      do_and_kill(
        [&] {
          for (;; ++checkpoint.step)
            write_checkpoint(file, checkpoint);
        },
        std::chrono::milliseconds(20 + kill));
      EXPECT_GE(read_checkpoint(file).step, 0);
    }
}
