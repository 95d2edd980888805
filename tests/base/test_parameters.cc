#include <samara/base/parameters.h>

#include <gtest/gtest.h>

#include <sstream>

using namespace samara;
namespace Patterns = dealii::Patterns;

namespace
{
  using Strings = std::vector<std::string>;

  /** An object as it stands in the code: variables, and one place that declares them. */
  struct RigidBody
  {
    RigidBody()
      : parameters("hub", "rigid body")
    {
      parameters.add("Mass", mass, "Mass [kg].", Patterns::Double(0));
      parameters.add("Position", position, "Reference position [m].");
      parameters.add("Shape", shape, "What is drawn.", Patterns::Selection("none|sphere|box"));
      parameters.subsection("Drawing").add("Size", size, "Diameter [m].");
    }

    Strings
    parse(const std::string &text)
    {
      Complaints    complaints;
      const Outline outline = Outline::of_text(text, "a.prm", complaints);
      parameters.parse(outline, Quantities(), complaints);
      return complaints.all();
    }

    double          mass     = 1;
    Eigen::Vector3d position = Eigen::Vector3d(0, 0, 0.5);
    std::string     shape    = "sphere";
    double          size     = 0.25;
    Parameters      parameters;
  };



  TEST(Parameters, BindVariables)
  {
    RigidBody hub;
    EXPECT_EQ(hub.parse("set Type = rigid body\n"
                        "set Mass = 2 lb\n"
                        "set Position = (1, 2, 3) ft\n"
                        "subsection Drawing\n  set Size = 10 cm\nend\n"),
              Strings());
    EXPECT_DOUBLE_EQ(hub.mass, 0.90718474);
    EXPECT_TRUE(hub.position.isApprox(0.3048 * Eigen::Vector3d(1, 2, 3)));
    EXPECT_EQ(hub.shape, "sphere") << "not mentioned, not changed";
    EXPECT_DOUBLE_EQ(hub.size, 0.1);
  }



  TEST(Parameters, AllComplaintsAtOnce)
  {
    RigidBody hub;
    EXPECT_EQ(
      hub.parse("set Copy of = other\n"
                "set Mas = 3\n"
                "set Mass = -1\n"
                "set Position = 1, 2\n"
                "set Shape = spere\n"
                "subsection Drawings\nend\n"
                "subsection Drawing\n  set Size = 5 kg\n  set Colour = red\nend\n"),
      (Strings{
        "a.prm:2: <Mas> is not a parameter of <hub> (rigid body); did you mean <Mass>?",
        "a.prm:3: <Mass> of <hub> (rigid body): <-1> is not accepted: wanted is a number of at least 0, in [kg].",
        "a.prm:4: <Position> of <hub> (rigid body): <1, 2>: 3 values are wanted, not 2.",
        "a.prm:5: <Shape> of <hub> (rigid body): <spere> is not a choice; did you mean <sphere>?",
        "a.prm:6: <Drawings> is not a subsection of <hub> (rigid body); did you mean <Drawing>?",
        "a.prm:9: <Size> of <hub/Drawing> (rigid body): <5 kg> is a mass [kg], but [m] is wanted.",
        "a.prm:10: <Colour> is not a parameter of <hub/Drawing> (rigid body); known: Size."}));
    EXPECT_EQ(hub.mass, 1) << "what is refused changes nothing";
    EXPECT_EQ(hub.shape, "sphere");
    EXPECT_EQ(hub.size, 0.25);
  }



  TEST(Parameters, KnowWhatWasSetAndWhere)
  {
    RigidBody     hub;
    Complaints    complaints;
    const Outline outline = Outline::of_text("subsection hub\n  set Mass = 3\nend\n", "a.prm", complaints);
    hub.parameters.parse(*outline.section("hub"), Quantities(), complaints);
    EXPECT_TRUE(hub.parameters.is_set("Mass"));
    EXPECT_EQ(hub.parameters.where("Mass"), "a.prm:2");
    EXPECT_FALSE(hub.parameters.is_set("Position"));
    EXPECT_EQ(hub.parameters.where("Position"), "a.prm:1");
    EXPECT_EQ(hub.parameters.where(), "a.prm:1");
    EXPECT_FALSE(hub.parameters.subsection("Drawing").is_set("Size"));
    EXPECT_EQ(hub.parameters.subsection("Drawing").where("Size"), "a.prm:1");

    hub.parameters.require("Mass", complaints);
    EXPECT_TRUE(complaints.empty());
    hub.parameters.require("Position", complaints);
    EXPECT_EQ(complaints.all(),
              Strings{"a.prm:1: <hub> (rigid body): <Position> must be given: Reference position [m]."});
  }



  TEST(Parameters, EmptyIsNotGiven)
  {
    Parameters  parameters("hinge", "revolute");
    std::string body;
    parameters.add("Body A", body, "First frame.");
    Complaints complaints;
    parameters.parse(Outline::of_text("set Body A =", "a.prm", complaints), Quantities(), complaints);
    EXPECT_FALSE(parameters.require("Body A", complaints));
    EXPECT_EQ(complaints.all(), Strings{"a.prm:1: <hinge> (revolute): <Body A> must be given: First frame."});
  }



  TEST(Parameters, SayInWordsWhatIsWanted)
  {
    const auto wanted = [](const dealii::Patterns::PatternBase &pattern, const std::vector<double> &valid) {
      Parameters          parameters;
      std::vector<double> x = valid;
      parameters.add("x", x, "Numbers.", pattern);
      Complaints complaints;
      parameters.parse(Outline::of_text("set x = -9.5, 7", "a.prm", complaints), Quantities(), complaints);
      return complaints.empty() ? "" : complaints.all()[0].substr(complaints.all()[0].find("wanted"));
    };
    using namespace dealii::Patterns;
    EXPECT_EQ(wanted(List(Double(0), 3, 3), {1, 2, 3}), "wanted is three numbers of at least 0.");
    EXPECT_EQ(wanted(List(Double(), 1, 1), {1}), "wanted is a number.");
    EXPECT_EQ(wanted(List(Double(0, 0.5), 1, 6), {0.1}), "wanted is one to six numbers from 0 to 0.5.");
    EXPECT_EQ(wanted(List(Double(0), 15, 15), std::vector<double>(15, 1.)), "wanted is 15 numbers of at least 0.");
    EXPECT_EQ(wanted(List(Double(0), 1), {1}), "wanted is one or more numbers of at least 0.");
    EXPECT_EQ(wanted(List(Double(0)), {1}), "wanted is numbers of at least 0.");
    EXPECT_EQ(wanted(List(Integer(1)), {1}), "wanted is whole numbers of at least 1.");
    EXPECT_EQ(wanted(List(Integer(1, 4)), {1}), "wanted is whole numbers from 1 to 4.");
    EXPECT_EQ(wanted(List(Integer()), {1}), "wanted is whole numbers.");
  }



  // The original complains itself, and is of the same kind unless the copy has a type of its own.
  TEST(Parameters, CopiesAreSilentAboutWhatTheyInherit)
  {
    const auto complaints_of = [](const std::string &type) {
      Complaints    complaints;
      const Outline all = Outline::of_text("subsection one\n set Type = rigid body\n set Mass = -1\n set Mas = 1\n"
                                           " subsection Drawing\n  set Size = 1 kg\n end\n subsection X\n end\nend\n"
                                           "subsection two\n set Copy of = one\n set Shape = no\n" +
                                             type + "end\n",
                                           "a.prm",
                                           complaints);
      RigidBody     hub;
      hub.parameters.parse(*all.section("two"), Quantities(), complaints);
      return complaints.all();
    };
    EXPECT_EQ(complaints_of("").size(), 1u);
    EXPECT_EQ(complaints_of("set Type = rigid body\n").size(), 5u);
  }



  TEST(Parameters, UseConstants)
  {
    RigidBody  hub;
    Complaints complaints;
    Quantities quantities;
    quantities.add_constant("L", "6 ft", "a.prm:1", complaints);
    const auto outline = Outline::of_text("set Position = L, 2*L, 0", "a.prm", complaints);
    hub.parameters.parse(outline, quantities, complaints);
    EXPECT_TRUE(complaints.empty());
    EXPECT_TRUE(hub.position.isApprox(1.8288 * Eigen::Vector3d(1, 2, 0)));
  }



  TEST(Parameters, IgnoreWhatSomebodyElseReads)
  {
    RigidBody hub;
    EXPECT_EQ(hub.parse("subsection Frames\nend\n").size(), 1u);
    hub.parameters.ignore_subsection("Frames");
    EXPECT_EQ(hub.parse("subsection Frames\n subsection tip\n set x = 1\n end\nend\n"), Strings());
  }



  TEST(Parameters, TypeCanBeAnEntryOfOnesOwn)
  {
    Parameters  parameters;
    std::string type = "newmark";
    parameters.add("Type", type, "Which.", Patterns::Selection("newmark|energy"));
    Complaints complaints;
    parameters.parse(Outline::of_text("set Type = energy\nset x = 1", "a.prm", complaints), Quantities(), complaints);
    EXPECT_EQ(type, "energy");
    EXPECT_EQ(complaints.all(), Strings{"a.prm:2: <x> is not a parameter here; known: Type."});
  }



  TEST(Parameters, PrintedValuesReadAsTheSame)
  {
    RigidBody one, two;
    one.parse("set Mass = 1/3 lb\nset Position = (1, 2, 1/7) ft\nset Shape = box\n"
              "subsection Drawing\n set Size = 1 in\nend\n");
    std::ostringstream text;
    one.parameters.print(text);
    EXPECT_EQ(two.parse(text.str()), Strings());
    EXPECT_EQ(one.mass, two.mass);
    EXPECT_EQ(one.position, two.position);
    EXPECT_EQ(one.shape, two.shape);
    EXPECT_EQ(one.size, two.size);
  }



  TEST(Parameters, PrintDefaultsAsComments)
  {
    RigidBody hub, again;
    hub.parse("set Mass = 2\nset Shape = sphere\nsubsection Drawing\nend\n");
    std::ostringstream text;
    hub.parameters.print(text, " ");
    EXPECT_EQ(text.str(),
              " set Mass = 2\n # set Position = 0, 0, 0.5\n set Shape = sphere\n subsection Drawing\n"
              "   # set Size = 0.25\n end\n");
    again.parse(text.str());
    EXPECT_FALSE(again.parameters.is_set("Position"));
    EXPECT_TRUE(again.parameters.is_set("Shape"));
  }



  TEST(Parameters, AreDocumented)
  {
    RigidBody          hub;
    std::ostringstream text;
    hub.parameters.document(text);
    EXPECT_EQ(text.str(),
              "| entry | default | unit | meaning |\n"
              "|---|---|---|---|\n"
              "| Mass | 1 | kg | Mass [kg]. |\n"
              "| Position | 0, 0, 0.5 | m | Reference position [m]. |\n"
              "| Shape | sphere |  | What is drawn. One of: none, sphere, box. |\n"
              "| Drawing / Size | 0.25 | m | Diameter [m]. |\n");
  }



  TEST(Parameters, RefuseMistakesOfProgrammers)
  {
    RigidBody hub;
    double    x = -1;
    EXPECT_THROW(hub.parameters.add("Mass", x, "Again [kg]."), dealii::ExceptionBase);
    EXPECT_THROW(hub.parameters.add("Length", x, "Not SI [ft]."), dealii::ExceptionBase);
    EXPECT_THROW(hub.parameters.add("Length", x, "The default breaks its pattern [m].", Patterns::Double(0)),
                 dealii::ExceptionBase);
    EXPECT_THROW(hub.parameters.is_set("Masse"), dealii::ExceptionBase);
    EXPECT_THROW(hub.parameters.where("Masse"), dealii::ExceptionBase);
  }
} // namespace
