// What reading and checking a file costs grows with its size and not faster: four times as much takes four times as long,
// where it would be sixteen if something were looked for one by one. Ratios of processor time; the best of some attempts.

#include "../scene.h"
#include <gtest/gtest.h>
#include <samara/joints/lower_pairs.h>

#include <malloc.h>

#include <ctime>

using namespace samara;

namespace
{
  template <typename Action>
  double
  processor_time(const Action &action)
  {
    const auto start = std::clock();
    action();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
  }



  /** How much longer @p action(4 n) takes than @p action(n). */
  template <typename Action>
  double
  growth(const unsigned int n, const Action &action)
  {
    constexpr double good_enough = 6;
    double           smallest    = 1e300;
    for (unsigned int attempt = 0; attempt < 5 && smallest > good_enough; ++attempt)
      {
        const double one = processor_time([&]() { action(n); });
        smallest         = std::min(smallest, processor_time([&]() { action(4 * n); }) / one);
      }
    return smallest;
  }

  constexpr double between_linear_and_quadratic = 9;



  std::string
  repeat(const unsigned int n, const std::function<std::string(const std::string &)> &text)
  {
    std::string result;
    for (unsigned int i = 0; i < n; ++i)
      result += text(std::to_string(i));
    return result;
  }



  /** Bodies that hang on the ground by hinges. */
  std::string
  pendulums(const unsigned int n)
  {
    return "subsection Bodies\n" + repeat(n,
                                          [](const std::string &i) {
                                            return " subsection body " + i +
                                                   "\n  set Type = rigid body\n  set Mass = 1 kg\n  set Inertia = 1, 1, 1\n"
                                                   "  set Position = " +
                                                   i + ", 0, -1\n end\n";
                                          }) +
           "end\nsubsection Joints\n" + repeat(n,
                                               [](const std::string &i) {
                                                 return " subsection hinge " + i +
                                                        "\n  set Type = revolute\n  set Body A = ground\n  set Body B = body " +
                                                        i + "\n  set Position = " + i + ", 0, 0\n end\n";
                                               }) +
           "end\n";
  }



  /** The number of complaints. */
  std::size_t
  complaints_about(const std::string &text)
  {
    Complaints complaints;
    Outline::of_text(text, "a.prm", complaints);
    return complaints.count();
  }
} // namespace



TEST(Growth, OfWrongLines)
{
  EXPECT_LT(growth(20'000,
                   [](const unsigned int n) {
                     EXPECT_EQ(complaints_about(repeat(n, [](const std::string &i) { return "wrong " + i + "\n"; })), n);
                   }),
            between_linear_and_quadratic);
}



TEST(Growth, OfNestedSubsections)
{
  EXPECT_LT(growth(10'000,
                   [](const unsigned int n) {
                     const std::string begin = repeat(n, [](const std::string &i) { return "subsection " + i + "\n"; });
                     EXPECT_EQ(complaints_about(begin + repeat(n, [](const std::string &) { return "end\n"; })), 1u);
                   }),
            between_linear_and_quadratic);
}



TEST(Growth, OfSectionsEntriesAndCopies)
{
  EXPECT_LT(growth(5'000,
                   [](const unsigned int n) {
                     const auto section = [](const std::string &i) {
                       return "subsection s" + i + "\n set Copy of = s" + std::to_string(std::stoul(i) + 1) +
                              "\nend\nset e" + i + " = 1\n";
                     };
                     EXPECT_EQ(complaints_about(repeat(n, section) + "subsection s" + std::to_string(n) +
                                                "\n set x = 1\nend\n"),
                               0u);
                   }),
            between_linear_and_quadratic);
}



TEST(Growth, OfNamesThatAreLookedFor)
{
  EXPECT_LT(growth(10'000,
                   [](const unsigned int n) {
                     Model model;
                     for (unsigned int i = 0; i < n; ++i)
                       {
                         model.items.push_back(std::make_unique<Revolute>());
                         model.items.back()->name = "joint " + std::to_string(i);
                       }
                     for (unsigned int i = 0; i < n; ++i)
                       EXPECT_EQ(&model.find<Item>("joint " + std::to_string(i), "joint"), model.items[i].get());
                   }),
            between_linear_and_quadratic);
}



TEST(Growth, OfNamesThatAreNotThere)
{
  EXPECT_LT(growth(1'500,
                   [](const unsigned int n) {
                     const std::string wrong = repeat(n, [](const std::string &i) {
                       return "subsection l" + i + "\n set Type = point load\n set At = bode " + i + "\nend\n";
                     });
                     try
                       {
                         const Scene scene(pendulums(n) + "subsection Loads\n" + wrong + "end\n");
                         FAIL() << "nothing was thrown";
                       }
                     catch (const InputError &error)
                       {
                         EXPECT_EQ(error.complaints.size(), 1001u);
                       }
                   }),
            between_linear_and_quadratic);
}



TEST(Growth, OfBodiesAndJoints)
{
  EXPECT_LT(growth(1'000,
                   [](const unsigned int n) {
                     const Scene scene(pendulums(n));
                     EXPECT_EQ(scene.system.size(), 11 * n);
                   }),
            between_linear_and_quadratic);
}



// A chain of bodies, each welded to the one before it, from its end to its beginning.
TEST(Growth, OfWelds)
{
  EXPECT_LT(growth(10'000,
                   [](const unsigned int n) {
                     Model              model;
                     std::vector<Frame> frames;
                     for (unsigned int i = 0; i < n; ++i)
                       frames.push_back(model.add_node("node", Vector3(i, 0, 0), Matrix3::Identity()));
                     for (unsigned int i = n - 1; i > 0; --i)
                       model.weld(frames[i - 1], frames[i]);
                     model.close();
                     EXPECT_EQ(model.nodes.size(), 2u);
                     EXPECT_EQ(model.resolved(frames.back()).arm, Vector3(n - 1., 0, 0));
                   }),
            between_linear_and_quadratic);
}



// Ten thousand bodies with their joints fit into some hundred megabytes.
TEST(Growth, OfMemory)
{
  constexpr unsigned int n      = 1000;
  const auto             before = ::mallinfo2();
  const Scene            scene(pendulums(n));
  const auto             after = ::mallinfo2();
  EXPECT_LT((after.uordblks + after.hblkhd - before.uordblks - before.hblkhd) / n, 30'000u);
}
