/*
 * Problem:   stresses of the layers of a shell and their indices of failure
 * Reference: N/A and 6 M/h², 1.5 Q/h of a strip; classical lamination by hand; Navier's series of a laminate, whose
 *            deflection is that of 3D elasticity (tests/reference/sections/pagano_plates.csv)
 */

#include <samara/base/dense.h>
#include <samara/output/pictures.h>

#include "../output/scratch_folder.h"
#include "../output/vtu_arrays.h"
#include "../reference.h"
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "models.h"

using namespace samara;

namespace
{
  double
  probed(Scene &scene, const std::string &path)
  {
    return scene.input.model.probe(path).value(scene.context.state);
  }

  /** Layers of carbon, 0.5 mm each, in two angles. */
  const std::string carbon = R"(
subsection Materials
  subsection carbon
    set Type                 = orthotropic
    set E1                   = 140 GPa
    set E2                   = 10 GPa
    set G12                  = 5 GPa
    set nu12                 = 0.3
    set Density              = 1600
    set Tensile strength     = 1500 MPa, 50 MPa, 50 MPa
    set Compressive strength = 1200 MPa, 200 MPa, 200 MPa
    set Shear strength       = 70 MPa, 70 MPa, 60 MPa
  end
end
subsection Layups
  subsection cross
    set Material      = carbon
    set Angles        = 0/90/0
    set Ply thickness = 0.5 mm
  end
end
)";

  /** A strip 1 m × 0.1 m, clamped at x = 0, under forces along x = 1. */
  std::string
  strip(const std::string &material, const std::string &force, const std::string &top = "")
  {
    return top + R"(
set Analyses = static
subsection Bodies
  subsection s
    set Type     = shell
    set Patches  = u, 0.1*v, 0
    set Elements = 8, 1
    set Degree   = 3
)" + material +
           R"(
  end
end
subsection Joints
  subsection root
    set Type  = support
    set Along = s.edge u0
    set Fixed = displacement 1, displacement 2, displacement 3, rotation 1, rotation 2, rotation 3
  end
end
subsection Loads
  subsection tip
    set Type  = line load
    set Body  = s
    set Edge  = edge u1
    set Force = )" +
           force + R"(
  end
end
)";
  }

  const std::string steel = "    set E = 210 GPa\n    set Thickness = 10 mm\n    set Density = 7800\n";
} // namespace



// ν = 0: the strip is a beam, also at the clamped end.
TEST(LayersOfShells, OfAStripAreThoseOfABeam)
{
  Scene scene(strip(steel, "0, 0, 30"));
  scene.equilibrium();
  const double h = 0.01, M = 30 * 0.5, Q = 30;
  EXPECT_NEAR(probed(scene, "s.at 0.5 0.stress 11") / (6 * M / (h * h)), 1, 1e-5) << "the sign is that of the bottom";
  EXPECT_NEAR(probed(scene, "s.at 0.5 0.layer 1.stress 13") / (1.5 * Q / h), 1, 1e-4) << "in the middle of the layer";
  // over the surface: at the clamp, though no point of integration is there; moments are linear, and nothing is lacking
  EXPECT_NEAR(std::abs(probed(scene, "s.layers.stress 11")) / (6 * 30 / (h * h)), 1, 1e-5);
  EXPECT_NEAR(probed(scene, "s.layers.von Mises stress") / (6 * 30 / (h * h)), 1, 1e-3);
  EXPECT_LT(probed(scene, "s.layers.stress 11 error"), 1e-4 * 6 * 30 / (h * h));
}



// An offset moves the layers, not the stresses of a force through their middle.
TEST(LayersOfShells, OffsetsMoveThem)
{
  Scene scene(strip(steel + "    set Offset = 4 mm\n", "1, 0, 0"));
  scene.equilibrium();
  // a small force per length on the reference surface, 4 mm beside the middle: N/h and M = N z, 1 + 6 z/h at the bottom
  EXPECT_NEAR(probed(scene, "s.at 0.5 0.stress 11") / (1 / 0.01 * (1 + 6 * 0.4)), 1, 2e-3);
}



// Pulled by N, free to contract across: ε = A⁻¹ N, and each ply has Q ε in its own axes.
TEST(LayersOfShells, OfALaminateAreThoseOfClassicalLamination)
{
  Scene scene(strip("    set Layup = cross\n", "3e3, 0, 0", carbon));
  scene.equilibrium();
  const double    E1 = 140e9, E2 = 10e9, nu = 0.3, t = 0.5e-3, N = 3e3;
  const double    stiff = 1 / (1 - nu * nu * E2 / E1), Q11 = E1 * stiff, Q22 = E2 * stiff, Q12 = nu * E2 * stiff;
  Eigen::Matrix2d A;
  A << 2 * Q11 + Q22, 3 * Q12, 3 * Q12, 2 * Q22 + Q11;
  const Eigen::Vector2d e     = (A * t).inverse() * Eigen::Vector2d(N, 0);
  const double          along = Q11 * e(0) + Q12 * e(1), across = Q12 * e(0) + Q22 * e(1); // of 0
  const double          along_90 = Q12 * e(0) + Q11 * e(1), across_90 = Q22 * e(0) + Q12 * e(1);
  const auto            at = [&](const std::string &what) { return probed(scene, "s.at 0.5 0." + what); };
  EXPECT_NEAR(at("layer 1.stress 11") / along, 1, 1e-3);
  EXPECT_NEAR(at("layer 1.stress 22") / across, 1, 2e-2);
  EXPECT_NEAR(at("layer 2.stress 11") / along_90, 1, 2e-2);
  EXPECT_NEAR(at("layer 2.stress 22") / across_90, 1, 1e-3);
  EXPECT_NEAR(at("layer 3.stress 11") / along, 1, 1e-3);
  // matrix of the layer across fails first: a tension of 50 MPa
  EXPECT_NEAR(at("max stress index") / std::max(along / 1500e6, across_90 / 50e6), 1, 1e-3);
  EXPECT_EQ(at("max stress index"), at("layer 2.max stress index"));
  EXPECT_GT(at("layer 2.Hashin index"), at("layer 1.Hashin index"));
  EXPECT_GE(probed(scene, "s.layers.Tsai-Wu index"), at("Tsai-Wu index"));

  // in pictures: the index, and the layer it is of, where the stress is even
  const Drawing drawing = scene.system.draw(scene.context.state);
  unsigned int  n       = 0;
  for (const auto &field : drawing.fields)
    for (unsigned int i = 0; i < drawing.samples.size(); ++i)
      if (std::abs(drawing.samples[i].x(0) - 0.5) < 0.01)
        {
          n += field.name == "layer nearest to failure" || field.name == "index of failure" ||
               field.name == "membrane strain";
          if (field.name == "layer nearest to failure")
            {
              EXPECT_EQ(field(i), 2.f);
            }
          if (field.name == "membrane strain")
            {
              EXPECT_NEAR(field(i, 0) / e(0), 1, 1e-3);
            }
        }
  EXPECT_GT(n, 0u);

  // and how well it is known: where the peak is, a node, it is what is told of the largest
  const auto field_named = [&](const std::string &name) {
    for (const auto &field : drawing.fields)
      if (field.name == name)
        return &field;
    throw std::runtime_error("there is no field " + name);
  };
  const auto  &values = *field_named("von Mises stress"), &errors = *field_named("von Mises stress error");
  unsigned int peak = 0;
  for (unsigned int i = 0; i < drawing.samples.size(); ++i)
    if (values(i) > values(peak))
      peak = i;
  EXPECT_NEAR(values(peak) / probed(scene, "s.layers.von Mises stress"), 1, 1e-5);
  EXPECT_NEAR(errors(peak) / probed(scene, "s.layers.von Mises stress error"), 1, 1e-3);
  EXPECT_GT(errors(peak), 0);
  EXPECT_GE((*field_named("index of failure error"))(peak), 0);
}



namespace
{
  /** The layers that a picture shows at a place of the reference surface: fields by layer and height in it. */
  class LayersInPicture
  {
  public:
    LayersInPicture(Scene &scene, const double x, const double y)
    {
      const ScratchFolder folder;
      Pictures            pictures(folder.path, "static");
      pictures.add(scene.system.draw(scene.context.state), 0);
      pictures.finish();
      text                 = content_of(folder.path + "/pictures/static.0000.vtu");
      objects              = content_of(folder.path + "/static.objects.txt");
      places               = numbers_of<float>(text, "Points");
      const auto displaced = numbers_of<float>(text, "displacement");
      for (unsigned int i = 0; i < places.size(); ++i)
        places[i] -= displaced[i];
      for (unsigned int i = 0; 3 * i < places.size(); ++i)
        if (std::hypot(places[3 * i] - x, places[3 * i + 1] - y) < 1e-5)
          here.push_back(i);
    }

    bool
    has(const std::string &field) const
    {
      return contains(text, "Name=\"" + field + "\"");
    }

    /** Of all cells at the place; layers from 1. */
    std::vector<double>
    values(const std::string &field, const unsigned int layer, const int side) const
    {
      const auto          all = of(field), layers = of("layer"), sides = of("height in layer");
      std::vector<double> result;
      for (const auto i : here)
        if (layers[i] == layer && sides[i] == side)
          result.push_back(all[i]);
      EXPECT_FALSE(result.empty()) << field;
      return result;
    }

    /** Of the cells the mean. */
    double
    value(const std::string &field, const unsigned int layer, const int side) const
    {
      double     sum = 0;
      const auto all = values(field, layer, side);
      for (const double v : all)
        sum += v;
      return sum / all.size();
    }

    /** Reference heights of the points of a layer [m]. */
    std::set<float>
    heights(const unsigned int layer) const
    {
      const auto      layers = of("layer");
      std::set<float> result;
      for (const auto i : here)
        if (layers[i] == layer)
          result.insert(std::round(1e7f * places[3 * i + 2]) / 1e7f);
      return result;
    }

    std::string objects;

  private:
    std::string               text;
    std::vector<float>        places;
    std::vector<unsigned int> here;

    std::vector<float>
    of(const std::string &field) const
    {
      EXPECT_TRUE(has(field)) << field;
      return has(field) ? numbers_of<float>(text, field) : std::vector<float>(places.size() / 3);
    }
  };
} // namespace



// Bent by M = F (1 − x), beside the reference surface, and sheared: each layer has the stresses of classical
// lamination at its bottom, middle and top, at its height; the largest of the three is what the probe tells.
TEST(LayersOfShells, InPictures)
{
  const double F = 0.1, M = 0.5 * F, offset = 1e-3, t = 0.5e-3;
  Scene        scene(
    strip("    set Layup = cross\n    set Offset = 1 mm\n    set Layers in pictures = true\n", "0, 0, 0.1", carbon));
  scene.equilibrium();
  const LayersInPicture picture(scene, 0.5, 0);
  EXPECT_EQ(picture.objects, "object\tname\tsubsection\tkind\n0\ts\tBodies\tshell\n1\ts layers\tBodies\tshell\n");

  const double    E1 = 140e9, E2 = 10e9, nu = 0.3, stiff = 1 / (1 - nu * nu * E2 / E1);
  const double    Q11 = E1 * stiff, Q22 = E2 * stiff, Q12 = nu * E2 * stiff;
  const double    inner = 2 * std::pow(t / 2, 3) / 3, outer = 2 * std::pow(3 * t / 2, 3) / 3 - inner;
  Eigen::Matrix2d D;
  D << Q11 * outer + Q22 * inner, Q12 * (outer + inner), Q12 * (outer + inner), Q22 * outer + Q11 * inner;
  const Eigen::Vector2d k = D.inverse() * Eigen::Vector2d(1, 0); // of a unit moment
  // shear stress of a unit force: what the plies below pull
  const double through = (Q11 * k(0) + Q12 * k(1)) * t * t, to_middle = through + (Q22 * k(0) + Q12 * k(1)) * t * t / 8;
  // a force upwards pulls the bottom
  for (unsigned int layer = 1; layer <= 3; ++layer)
    for (int side = -1; side <= 1; ++side)
      {
        const double z = (layer - 2. + 0.5 * side) * t, bent = -M * z;
        const double along  = layer == 2 ? Q12 * k(0) + Q11 * k(1) : Q11 * k(0) + Q12 * k(1),
                     across = layer == 2 ? Q22 * k(0) + Q12 * k(1) : Q12 * k(0) + Q22 * k(1);
        const double bound  = 5e-3 * M * t * Q11 * k(0);
        for (const double height : picture.values("height", layer, side))
          EXPECT_NEAR(height, offset + z, 1e-9);
        EXPECT_NEAR(picture.value("stress 11", layer, side), bent * along, bound) << layer << side;
        EXPECT_NEAR(picture.value("stress 22", layer, side), bent * across, bound) << layer << side;
      }
  EXPECT_EQ(picture.heights(2).size(), 3u);
  EXPECT_NEAR(*picture.heights(2).begin(), offset - t / 2, 1e-7);
  EXPECT_NEAR(*picture.heights(2).rbegin(), offset + t / 2, 1e-7);
  // at a free edge the shear force is some percent more than its mean, F: it makes good for the twisting moment there
  const double Q = probed(scene, "s.at 0.5 0.shear 1");
  EXPECT_NEAR(Q / F, 1, 0.1);
  EXPECT_NEAR(picture.value("stress 13", 1, 1) / (Q * through), 1, 1e-4);
  EXPECT_NEAR(std::abs(picture.value("stress 23", 2, 0)) / (Q * to_middle), 1, 1e-4) << "turned with the ply";
  EXPECT_NEAR(picture.value("stress 13", 1, -1), 0, 1e-4 * Q * through) << "a free face";
  const std::string quantities[] = {"stress 11",
                                    "stress 22",
                                    "stress 33",
                                    "stress 12",
                                    "stress 13",
                                    "stress 23",
                                    "von Mises stress",
                                    "max stress index",
                                    "Tsai-Wu index",
                                    "Hashin index"};
  for (unsigned int layer = 1; layer <= 3; ++layer)
    for (const auto &quantity : quantities)
      {
        double largest = 0;
        for (int side = -1; side <= 1; ++side)
          largest = std::max(largest, std::abs(picture.value(quantity, layer, side)));
        const double probe = probed(scene, "s.at 0.5 0.layer " + std::to_string(layer) + "." + quantity);
        // cells at the node differ a little, and a stress of none is not compared
        EXPECT_NEAR(largest,
                    std::abs(probe),
                    1e-3 * std::abs(probe) + (quantity.back() == 'x' ? 0. : 1e-4 * M * t * Q11 * k(0)))
          << layer << quantity;
      }
  EXPECT_FALSE(picture.has("von Mises index")) << "there is no yield stress";
}



// A cylinder of radius 1, one patch of three layers and one of one: each point is at the height of its layer outside of
// it, and moves as the normal takes it along.
TEST(LayersOfShells, InPicturesAreAlongTheNormal)
{
  std::string layups = carbon;
  layups.replace(layups.find("  subsection cross"), 0, "  subsection one\n    set Plies = carbon, 30, 2 mm\n  end\n");
  Scene scene(layups + R"(
subsection Bodies
  subsection s
    set Type               = shell
    set Patches            = cos(u), sin(u), v; cos(1 + u), sin(1 + u), v
    set Elements           = 4, 1
    set Degree             = 4
    set Axis 1             = 0, 0, 1
    set Patch layups       = cross, one
    set Layers in pictures = true
    set Angular velocity   = 0, 0, 2
  end
end
)");
  scene.system.add_initial_velocities(scene.context.state);
  const Drawing drawing = scene.system.draw(scene.context.state);
  std::set<int> of_first, of_second;
  const Field  *layer = nullptr, *height = nullptr;
  for (const auto &field : drawing.fields)
    if (field.name == "layer")
      layer = &field;
    else if (field.name == "height")
      height = &field;
  ASSERT_TRUE(layer != nullptr && height != nullptr);
  for (unsigned int i = 0; i < drawing.samples.size(); ++i)
    if (!std::isnan((*layer)(i)))
      {
        const Vector3 &x = drawing.samples[i].x, radial(x(0), x(1), 0);
        EXPECT_NEAR(radial.norm(), 1 + (*height)(i), 1e-6);
        // the angular velocity is about the first node, at (1, 0, 0)
        EXPECT_NEAR((drawing.samples[i].velocity - 2 * Vector3(-x(1), x(0) - 1, 0)).norm(), 0, 1e-9);
        if (const double angle = std::atan2(x(1), x(0)); std::abs(angle - 1) > 0.01) // not at the common edge
          (angle < 1 ? of_first : of_second).insert((*layer)(i));
      }
  EXPECT_EQ(of_first, std::set<int>({1, 2, 3}));
  EXPECT_EQ(of_second, std::set<int>({1}));
}



// A rigid shell, of whose stresses nothing is known, shows none.
TEST(LayersOfShells, InPicturesOnlyWhereTheyAreKnown)
{
  Scene scene(strip(steel + "    set Layers in pictures = true\n    set Rigid = true\n", "0, 0, 1"));
  for (const auto &field : scene.system.draw(scene.context.state).fields)
    EXPECT_NE(field.name, "layer");
}



namespace
{
  /** A simply supported square [0/90/0] of side a and thickness 1 under an even load 1: Navier's series. */
  struct Navier
  {
    double deflection = 0, curvature_1 = 0, curvature_2 = 0; ///< in the middle
    double of_sine = 0;                                      ///< the deflection under sin sin

    Navier(const double a, const double G1, const double G2)
    {
      const double stiff = 1 / (1 - 0.25 * 0.25 / 25), inner = 2. / 3 / 216, outer = 2. / 3 * (1. / 8 - 1. / 216);
      const double D11 = stiff * (25 * outer + inner), D22 = stiff * (outer + 25 * inner),
                   D12 = stiff * 0.25 * (outer + inner), D66 = 0.5 * (outer + inner);
      for (int m = 1; m < 60; m += 2)
        for (int n = 1; n < 60; n += 2)
          {
            // w = W sin sin, rotations X cos sin and Y sin cos
            const double    p = m * M_PI / a, q = n * M_PI / a;
            Eigen::Matrix3d K;
            K << G1 * p * p + G2 * q * q, G1 * p, G2 * q,                  //
              G1 * p, G1 + D11 * p * p + D66 * q * q, (D12 + D66) * p * q, //
              G2 * q, (D12 + D66) * p * q, G2 + D22 * q * q + D66 * p * p;
            const Eigen::Vector3d u = K.inverse().col(0);
            const double          part =
              16 / (M_PI * M_PI * m * n) * ((m / 2 + n / 2) % 2 == 0 ? 1 : -1); // of the load, in the middle
            if (m == 1 && n == 1)
              of_sine = u(0);
            deflection += part * u(0);
            curvature_1 -= part * p * u(1);
            curvature_2 -= part * q * u(2);
          }
    }
  };

  std::string
  pagano_plate(const double a)
  {
    std::ostringstream text;
    text << R"(
set Analyses = static
subsection Materials
  subsection ply
    set Type = orthotropic
    set E1   = 25
    set E2   = 1
    set G12  = 0.5
    set G23  = 0.2
    set nu12 = 0.25
    set nu23 = 0.25
  end
end
subsection Layups
  subsection l
    set Material      = ply
    set Angles        = 0/90/0
    set Ply thickness = 0.33333333333333333
  end
end
subsection Bodies
  subsection s
    set Type     = shell
    set Patches  = )"
         << a << "*u, " << a << R"(*v, 0
    set Elements = 4, 4
    set Degree   = 4
    set Layup    = l
  end
end
subsection Joints
  subsection x
    set Type  = support
    set Along = s.edge u0, s.edge u1
    set Fixed = displacement 2, displacement 3, rotation 1
  end
  subsection y
    set Type  = support
    set Along = s.edge v0, s.edge v1
    set Fixed = displacement 1, displacement 3, rotation 2
  end
end
subsection Loads
  subsection q
    set Type  = area load
    set Body  = s
    set Force = 0, 0, 1e-8
  end
end
)";
    return text.str();
  }
} // namespace



// Navier's solution under sin sin is that of Pagano's plates as nearly as transverse shear by equilibrium is; the shell
// has Navier's deflection and stresses under an even load.
TEST(LayersOfShells, OfPaganosPlate)
{
  unsigned int n = 0;
  for (const auto &row : reference_rows("sections/pagano_plates.csv"))
    {
      const double a = std::stod(row.at("a_over_h"));
      if (row.at("layup") != "0/90/0" || (a != 10 && a != 20))
        continue;
      const Navier exact(a, std::stod(row.at("G11_rule")), std::stod(row.at("G22_rule")));
      EXPECT_NEAR(100 * exact.of_sine / std::pow(a, 4) / std::stod(row.at("w_mean")), 1, a < 15 ? 0.017 : 4e-3);
      Scene scene(pagano_plate(a));
      scene.equilibrium();
      const auto   at    = [&](const std::string &what) { return probed(scene, "s.at 0.5 0.5." + what) / 1e-8; };
      const double stiff = 1 / (1 - 0.25 * 0.25 / 25), k1 = exact.curvature_1, k2 = exact.curvature_2;
      EXPECT_NEAR(at("displacement z") / exact.deflection, 1, 1e-3) << a;
      EXPECT_NEAR(std::abs(at("layer 3.stress 11")) / std::abs(stiff * (25 * k1 + 0.25 * k2) / 2), 1, 5e-3) << a;
      EXPECT_NEAR(std::abs(at("layer 2.stress 11")) / std::abs(stiff * (25 * k2 + 0.25 * k1) / 6), 1, 5e-3) << a;
      EXPECT_NEAR(std::abs(at("layer 1.stress 22")) / std::abs(stiff * (k2 + 0.25 * k1) / 2), 1, 5e-3) << a;
      ++n;
    }
  EXPECT_EQ(n, 2u);
}



// What is asked for and cannot be known is refused by name.
TEST(LayersOfShells, Refusals)
{
  Scene      scene(strip("    set Layup = cross\n", "1, 0, 0", carbon));
  const auto refusal = [&](const std::string &path) -> std::string {
    try
      {
        scene.input.model.probe(path);
      }
    catch (const std::invalid_argument &problem)
      {
        return problem.what();
      }
    return "";
  };
  EXPECT_NE(refusal("s.layer 4.stress 11").find("3 layers"), std::string::npos);
  EXPECT_NE(refusal("s.layer 0.stress 11").find("no <layer 0>"), std::string::npos);
  EXPECT_NE(refusal("s.layers.von Mises index").find("needs more strengths"), std::string::npos);
  EXPECT_NE(refusal("s.at 0.5 0.3.stress 11").find("no node"), std::string::npos);
}



// Under an even load the moment at the clamp is q l²/2, beyond all points of integration: 6 M/h². The error that is
// told bounds the one that is found, and falls with the mesh.
TEST(LayersOfShells, PeaksAreAtTheFacesOfCells)
{
  const double      h = 0.01, q = 100;
  std::string       text = strip(steel, "0, 0, 100");
  const std::string line = "line load\n    set Body  = s\n    set Edge  = edge u1\n";
  text.replace(text.find(line), line.size(), "area load\n    set Body  = s\n");
  double told_before = 0;
  for (const std::string n : {"1", "2", "4"})
    for (const std::string p : {"2", "3"})
      {
        Scene scene(text, {"Bodies/s/Elements = " + n + ", 1", "Bodies/s/Degree = " + p});
        scene.equilibrium();
        const double exact = 3 * q / (h * h), peak = std::abs(probed(scene, "s.layers.stress 11")),
                     error = probed(scene, "s.layers.stress 11 error");
        EXPECT_LE(std::abs(peak - exact), error + 1e-4 * exact) << n << ' ' << p << ": " << peak / exact;
        if (p == "3")
          {
            EXPECT_NEAR(peak / exact, 1, 1e-4) << n;
            continue;
          }
        if (told_before > 0)
          {
            EXPECT_LT(error, 0.5 * told_before) << n;
          }
        told_before = error;
      }
  Scene scene(text);
  EXPECT_THROW(probed(scene, "s.at 0.5 0.stress 11 error"), std::invalid_argument);
}



// A square of [0/90/0] in sin sin: against solids σ₁₁ at the faces is 0.590 of q (a/h)² at a/h = 10, 0.801 at 4 (Pagano
// 1970), and plates with one shear angle have 0.513 and 0.437: 13 and 45 % are missing. To first order in the ratio of
// energies, π² D/(G a²) in such a wave, this is foretold to a fifth. A homogeneous plate has 1/6.
TEST(LayersOfShells, WarpingOfThickLaminates)
{
  const auto lamina = [](const double E1, const double nu, const double G12, const double G23, const double degrees) {
    // E₂ = E₃ = 1, G₁₃ = G₁₂; Voigt order 11 22 33 23 13 12
    Matrix6 compliance = Matrix6::Zero();
    compliance.diagonal() << 1 / E1, 1, 1, 1 / G23, 1 / G12, 1 / G12;
    compliance(0, 1) = compliance(1, 0) = compliance(0, 2) = compliance(2, 0) = -nu / E1;
    compliance(1, 2) = compliance(2, 1) = -nu;
    return Lamina{compliance.inverse(), degrees * M_PI / 180, 1. / 3, 0};
  };
  const Laminate even({lamina(1, 0.3, 1 / 2.6, 1 / 2.6, 0), lamina(1, 0.3, 1 / 2.6, 1 / 2.6, 0)});
  EXPECT_NEAR(even.warping(0), 1. / 6, 1e-12);
  EXPECT_NEAR(even.warping(1), 1. / 6, 1e-12);

  const auto     ply = [&](const double degrees) { return lamina(25, 0.25, 0.5, 0.2, degrees); };
  const Laminate cross({ply(0), ply(90), ply(0)});
  for (const auto &[slenderness, missing] :
       {std::make_pair(10., 1 - 0.513 / 0.590), std::make_pair(4., 1 - 0.437 / 0.801)})
    {
      const double r     = std::pow(M_PI / slenderness, 2) * cross.ABD(3, 3) / cross.shear(0, 0),
                   added = cross.warping(0) * r;
      EXPECT_NEAR(added / (1 + added), missing, 0.2 * missing) << slenderness;
    }
}



// Under an even load, which has shorter waves, too, some more is told of than in sin sin; of thin ones nothing.
TEST(LayersOfShells, ThickLaminatesAreToldOf)
{
  const auto told = [](const double thickness) {
    const std::string third = number_to_text(thickness / 3);
    Scene             scene(
      "subsection Materials\n subsection ply\n set Type = orthotropic\n set E1 = 25\n set E2 = 1\n set nu12 = 0.25\n set nu23 = 0.25\n"
                  " set G12 = 0.5\n set G23 = 0.2\n end\nend\nsubsection Layups\n subsection cross\n set Material = ply\n"
                  " set Angles = 0/90/0\n set Ply thickness = " +
      third +
      "\n end\nend\nsubsection Bodies\n subsection s\n set Type = shell\n set Patches = u, v, 0\n set Elements = 3, 3\n"
                  " set Layup = cross\n set Degree = 3\n set Layers in pictures = true\n end\nend\nsubsection Joints\n" +
      support("x", "s.edge u0, s.edge u1", "displacement 2, displacement 3, rotation 1") +
      support("y", "s.edge v0, s.edge v1", "displacement 1, displacement 3, rotation 2") +
      "end\nsubsection Loads\n subsection even\n set Type = area load\n set Body = s\n set Force = 0, 0, 1e-6\n end\nend\n");
    scene.equilibrium();
    const std::string text = scene.stream.str(), words = "Stresses along the layers are up to some ";
    const auto        at = text.find(words);
    return at == std::string::npos ? 0. : std::stod(text.substr(at + words.size()));
  };
  const double at_10 = told(0.1), at_4 = told(0.25);
  EXPECT_GT(at_10, 13);
  EXPECT_LT(at_10, 1.5 * 13);
  EXPECT_GT(at_4, 45);
  EXPECT_LT(at_4, 1.5 * 45);
  EXPECT_EQ(told(0.01), 0);
}
