// `Analyses = verification`: what it finds of right elements, and that it finds wrong ones.

#include <samara/analysis/verification.h>
#include <samara/cosserat/beam.h>
#include <samara/cosserat/prototype.h>

#include "scene.h"

using namespace samara;

namespace
{
  /** A strut whose tangent has lost its geometric part. */
  class WrongStrut : public Strut
  {
  public:
    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      Point<double>             without = point;
      const std::vector<double> none(first_strain + 1, 0.);
      without.stress = none.data();
      Strut::tangent(without, K);
    }
  };

  /** A beam whose strains see in which direction it lies. */
  class LostBeam : public Prototype<LostBeam, Beam, 1>
  {
  public:
    template <typename Number>
    void
    strains_of(const PrototypeElement<1> &element, const kernel::NodeValues<Number> *nodes, Number *e) const
    {
      for (int k = 0; k < 3; ++k)
        {
          e[k]     = (nodes[1].x(k) - nodes[0].x(k)) * Number(element.slope(0, 1, 0));
          e[3 + k] = axial(nodes[0].D.transpose() * nodes[1].D)(k);
        }
    }
  };

  Catalogue
  catalogue_with_wrong_ones()
  {
    Catalogue result = catalogue_with_skeletons();
    for (auto &group : result.groups)
      {
        if (group.subsection == "Joints")
          group.kinds.add<WrongStrut>("wrong strut", "strut without geometric stiffness");
        if (group.subsection == "Bodies")
          group.kinds.add<LostBeam>("lost beam", "beam of which rigid motions change the strains");
      }
    return result;
  }

  const std::string verified = "set Analyses = verification\n";

  /** What the analysis says is wrong; empty if nothing is. */
  std::string
  objection(SmallScene &scene)
  {
    try
      {
        scene.analysis<VerificationAnalysis>().run(scene.context);
        return "";
      }
    catch (const NotConverged &problem)
      {
        return problem.what();
      }
  }

  std::string
  beam(const std::string &kind)
  {
    return verified +
           "subsection Sections\n subsection s\n set Type = rectangle\n set E = 70e9\n set Density = 2700\n "
           "set Width 2 = 0.04\n set Width 3 = 0.02\n end\nend\nsubsection Bodies\n subsection rod\n set Type = " +
           kind +
           "\n set Points = 0, 0, 0; 1, 0.3, 0.1\n set Degree = 1\n set Elements = 3\n set Section = s\n end\nend\n";
  }
} // namespace



TEST(Verification, OfTheShippedElements)
{
  std::ostringstream text;
  text << std::ifstream(std::string(SAMARA_SOURCE_DIR) + "/prm/verification/elements.prm").rdbuf();
  SmallScene scene(text.str());
  EXPECT_EQ(objection(scene), "");
  const auto &found = scene.analysis<VerificationAnalysis>();
  ASSERT_EQ(found.rows.size(), 4);
  EXPECT_LT(found.error_of_tangent, 1e-13);
  for (const auto &row : found.rows)
    {
      EXPECT_EQ(row.n_free_motions, 6) << row.name;
      EXPECT_LT(row.change_in_motion, 1e-12) << row.name;
      if (row.kind == "geodesic beam")
        EXPECT_GT(row.third_difference, 1e-3);
      else
        EXPECT_LT(row.third_difference, 1e-11) << row.name;
    }
}



TEST(Verification, NamesWhereATangentIsWrong)
{
  const std::string line = "\n set Point A = a.ear\n set Point B = b.ear\n set EA = 7\n";
  SmallScene right(verified + two_blocks + joint("line", "set Type = strut" + line), catalogue_with_wrong_ones()),
    wrong(verified + two_blocks + joint("line", "set Type = wrong strut" + line), catalogue_with_wrong_ones());
  EXPECT_EQ(objection(right), "");
  const std::string said = objection(wrong);
  EXPECT_TRUE(contains(said, "is not the derivative of the forces")) << said;
  EXPECT_TRUE(contains(said, "row <")) << said;
  // two bodies of six motions each, one of which strains the strut
  ASSERT_EQ(right.analysis<VerificationAnalysis>().rows.size(), 1);
  EXPECT_EQ(right.analysis<VerificationAnalysis>().rows[0].n_free_motions, 11);
}



TEST(Verification, FindsStrainsOfRigidMotions)
{
  SmallScene right(beam("beam"), catalogue_with_wrong_ones()), lost(beam("lost beam"), catalogue_with_wrong_ones());
  EXPECT_EQ(objection(right), "");
  const std::string said = objection(lost);
  EXPECT_TRUE(contains(said, "lost beam <rod> is strained by a rigid motion")) << said;
}
