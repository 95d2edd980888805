#include <samara/base/registry.h>

#include <gtest/gtest.h>

using namespace samara;

namespace
{
  struct Shape
  {
    virtual ~Shape()            = default;
    virtual int corners() const = 0;
  };

  struct Square : Shape
  {
    int
    corners() const override
    {
      return 4;
    }
  };

  struct Polygon : Shape
  {
    explicit Polygon(const int n)
      : n(n)
    {}

    int
    corners() const override
    {
      return n;
    }

    int n;
  };

  Registry<Shape>
  shapes()
  {
    Registry<Shape> registry;
    registry.add<Square>("square", "Four corners.");
    registry.add("pentagon", "Five corners.", []() { return std::make_unique<Polygon>(5); });
    return registry;
  }



  TEST(Registry, MakesWhatIsNamed)
  {
    const auto registry = shapes();
    EXPECT_EQ(registry.make("square")->corners(), 4);
    EXPECT_EQ(registry.make("pentagon")->corners(), 5);
    EXPECT_EQ(registry.what_it_is("pentagon"), "Five corners.");
  }



  TEST(Registry, KeepsTheOrderOfTheCatalogue)
  {
    EXPECT_EQ(shapes().kinds(), (std::vector<std::string>{"square", "pentagon"}));
    EXPECT_TRUE(shapes().contains("square"));
    EXPECT_FALSE(shapes().contains("circle"));
  }



  TEST(Registry, TwoAreIndependent)
  {
    auto one = shapes();
    one.add<Square>("quad", "The same.");
    EXPECT_TRUE(one.contains("quad"));
    EXPECT_FALSE(shapes().contains("quad"));
  }



  TEST(Registry, RefusesTwoOfOneName)
  {
    auto registry = shapes();
    EXPECT_THROW(registry.add<Square>("square", "Again."), dealii::ExceptionBase);
    EXPECT_THROW(registry.add("none", "No factory.", nullptr), dealii::ExceptionBase);
  }



  TEST(Registry, SaysWhatIsKnown)
  {
    try
      {
        shapes().make("sqare", "a.prm:7");
        FAIL() << "nothing was thrown";
      }
    catch (const InputError &e)
      {
        EXPECT_STREQ(e.what(), "a.prm:7: there is no kind <sqare>; did you mean <square>?");
      }
    EXPECT_THROW(shapes().what_it_is("circle"), InputError);
  }
} // namespace
