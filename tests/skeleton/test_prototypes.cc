// Elements of which only the strains are written (cosserat/prototype.h): against the built-in ones where strains are
// the same, and the two that are shipped against closed forms and orders.

#include <samara/analysis/dynamic.h>
#include <samara/cosserat/geodesic_beam.h>

#include "scene.h"


using namespace samara;

namespace
{
  /** The built-in quadratic beam again, by its strains alone. */
  class AutomaticBeam : public Prototype<AutomaticBeam, Beam, 2>
  {
  public:
    template <typename Number>
    void
    strains_of(const PrototypeElement<1> &element, const kernel::NodeValues<Number> *nodes, Number *e) const
    {
      for (unsigned int g = 0; g < element.table.n_points; ++g)
        {
          double shape[3], slope[3];
          for (unsigned int a = 0; a < 3; ++a)
            {
              shape[a] = element.value(g, a);
              slope[a] = element.slope(g, a, 0);
            }
          const Vec6<Number> strain = kernel::strain(kernel::interpolate(nodes, 3, shape, slope));
          std::copy_n(strain.data(), 6, e + 6 * g);
        }
    }
  };

  /** As a prototype's writer would add it to the catalogue. */
  struct PrototypeScene : SmallScene
  {
    static Catalogue
    catalogue()
    {
      Catalogue result = catalogue_with_skeletons();
      for (auto &group : result.groups)
        if (group.subsection == "Bodies")
          group.kinds.add<AutomaticBeam>("automatic beam", "the quadratic beam by its strains alone");
      return result;
    }
    explicit PrototypeScene(const std::string &text)
      : SmallScene(text, catalogue())
    {}
  };

  std::string
  arch(const std::string &kind, const std::string &entries, const std::string &rest = "")
  {
    return R"(
subsection Sections
  subsection full
    set Type = matrices
    set Stiffness = 900, 1, .5, .2, .3, .1, 700, .4, .3, .2, .6, 600, .1, .5, .2, 3, .2, .1, 2, .3, 4
    set Inertia = 2, 2, 2, 0.3, 0.2, 0.4
  end
end
subsection Bodies
  subsection arch
    set Shape = arc
    set Points = 0, 0, 0; 1, 0.5, 0.2; 2, 0, 0.1
    set Twist = 0.3*s
    set Section = full
    set Type = )" +
           kind + "\n" + entries + "\n  end\nend\n" + rest;
  }

  const std::string damped = "set Elements = 3\n set Damping = 0.1, 0.2, 0.3, 0.4, 0.5, 0.6";

  const std::string clamped_and_loaded = R"(
subsection Joints
  subsection clamp
    set Type = rigid
    set Body A = ground
    set Body B = arch.start
  end
end
subsection Loads
  subsection pull
    set Type = point load
    set At = arch.end
    set Force = 0.3, 0.5, 0.8
    set Moment = 0.1, -0.2, 0.4
  end
end
)";

  /** The end of the 45 degree bend of Bathe and Bolourchi with so many elements. */
  Vector3
  end_of_bend(const std::string &kind, const unsigned int n_elements)
  {
    const std::string  model = std::string(SAMARA_SOURCE_DIR) + "/prm/benchmarks/bend_45.prm";
    Input              input(Catalogue(),
                model,
                {"Bodies/bend/Type = " + kind,
                              "Bodies/bend/Degree = 1",
                              "Bodies/bend/Elements = " + std::to_string(n_elements)});
    System             system(input.model);
    std::ostringstream stream;
    Log                log(stream);
    Context            context{system, log, "", {}, false, system.reference(), {}, {}};
    StaticAnalysis     analysis;
    analysis.start(context);
    analysis.run(context);
    return {input.model.probe("bend.end.position x").value(context.state),
            input.model.probe("bend.end.position y").value(context.state),
            input.model.probe("bend.end.position z").value(context.state)};
  }

  /** What a thrown, bent arch makes of its energy in a few steps of one stage, of the largest energy. */
  double
  energy_made(const std::string &kind, const double h)
  {
    const PrototypeScene scene(
      arch(kind,
           "set Elements = 4\n set Angular velocity = 2, 3, 4\n",
           "subsection Loads\n subsection push\n set Type = point load\n set At = arch.end\n set "
           "Force = 3, 5, 8\n set Axes = body\n end\nend\n"));
    StageIntegrator integrator(scene.system, Tableau(1, 1.), 1e-13);
    State           state = scene.context.state;
    scene.system.add_initial_velocities(state);
    scene.system.stresses(state, state.stress);
    const auto before = scene.system.energy(state);
    double     work = 0, kinetic = before.kinetic;
    for (double t = 0; t < 0.1 - 1e-9; t += h)
      {
        const StepResult result = integrator.step(state, h);
        EXPECT_TRUE(result.converged) << kind << ' ' << h;
        work += result.work_of_loads;
        kinetic = std::max(kinetic, result.energy->kinetic);
      }
    const auto after = scene.system.energy(state);
    return std::abs(after.kinetic + after.strain - before.kinetic - before.strain - work) / kinetic;
  }
} // namespace



// The same strains by hand and by differentiation: forces, tangent and damping are the same, in any state.
TEST(Prototypes, AreTheBuiltInElementWithItsStrains)
{
  const PrototypeScene by_hand(arch("beam", "set Degree = 2\n " + damped)), automatic(arch("automatic beam", damped));
  const auto           matrices = [](const PrototypeScene &scene) {
    State               state = scene.system.reference();
    std::vector<double> z(scene.system.size()), r(scene.system.size() + 6, 0.);
    for (unsigned int i = 0; i < z.size(); ++i)
      z[i] = 0.3 * std::sin(1. + i);
    scene.system.update(state, z);
    scene.system.stresses(state, state.stress);
    SparseMatrix K(scene.system.layout.pattern), C(scene.system.layout.pattern);
    scene.system.add_tangent(state.point(), K);
    scene.system.add_damping(state.point(), C);
    scene.system.add_terms(state.point(), r.data());
    Eigen::MatrixXd all(z.size(), 2 * z.size() + 1);
    all << K.dense(), C.dense(), Eigen::Map<Eigen::VectorXd>(r.data(), z.size());
    return all;
  };
  const Eigen::MatrixXd expected = matrices(by_hand), found = matrices(automatic);
  ASSERT_EQ(found.cols(), expected.cols());
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}



TEST(Prototypes, TangentsAgreeWithComplexStep)
{
  const std::string plate =
    "subsection Bodies\n subsection plate\n set Type = MITC4 shell\n set Patches = u, v*(1+0.3*u), "
    "0.4*u*v\n set Elements = 2, 1\n set E = 5\n set Poisson ratio = 0.3\n set Thickness = 0.3\n "
    "set Density = 1\n set Damping = 0.2\n end\nend\n";
  for (const std::string &text : {arch("geodesic beam", damped), arch("automatic beam", damped), plate})
    {
      const PrototypeScene scene(text);
      for (const bool orthonormal : {true, false})
        {
          const ComplexStep check(scene.system, orthonormal);
          EXPECT_LT(check.error_of_tangent(), 1e-13) << text;
          EXPECT_LT(check.error_of_damping(), 1e-13) << text;
          EXPECT_LT(check.error_of_strain_rates(), 1e-13) << text;
        }
    }
}



// Of straight elements with constant curvatures order 2, towards the shooting solution.
TEST(Prototypes, GeodesicBeamConvergesWithOrderTwo)
{
  const Vector3 exact(15.684800534, 47.1504385736, 53.4748587918);
  double        last = 0;
  for (const unsigned int n : {8, 16, 32})
    {
      const double error = (end_of_bend("geodesic beam", n) - exact).norm();
      if (last > 0)
        {
          EXPECT_NEAR(std::log2(last / error), 2, 0.1) << n;
        }
      last = error;
    }
  EXPECT_LT(last, 0.1);
}



// Only where strains are quadratic a step of one stage keeps energy to round-off; otherwise it misses h².
TEST(Prototypes, EnergyIsKeptWhereStrainsAreQuadratic)
{
  EXPECT_LT(energy_made("automatic beam", 0.01), 1e-12);
  const double coarse = energy_made("geodesic beam", 0.01), fine = energy_made("geodesic beam", 0.005);
  EXPECT_GT(coarse, 1e-9);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}



TEST(Prototypes, RefuseAnotherDegree)
{
  const std::string text = arch("geodesic beam", "set Degree = 3");
  EXPECT_TRUE(contains(complaint(text), "geodesic beam <arch> has elements of degree 1, and no others"))
    << complaint(text);
}
