#include <samara/rotation/matrix6.h>
#include <samara/section/elasticity.h>
#include <samara/section/laminate.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** Voigt numbers of the in-plane strains 11, 12, 22 and of the transverse ones 13, 23. */
    constexpr int in_plane[3] = {0, 5, 1}, transverse[2] = {4, 3};



    /** σ₁₁ σ₁₂ σ₂₂ of unit M₁₁, M₂₂ as what they are in σ_α3 of unit Q₁, Q₂: M₁₁,₁ = Q₁ changes σ₁₁ and σ₁₂ along 1,
     * M₂₂,₂ = Q₂ changes σ₁₂ and σ₂₂ along 2. */
    Eigen::Matrix2d
    by_shear_force(const Eigen::Matrix<double, 3, 2> &of_moments)
    {
      Eigen::Matrix2d f;
      f << of_moments(0, 0), of_moments(1, 1), of_moments(1, 0), of_moments(2, 1);
      return f;
    }



    /** In plane at σ₃₃ = 0, σ₂₃ and σ₁₃ being zero as well. */
    Matrix3
    reduced_stiffness(const Matrix6 &C)
    {
      const Matrix6 F = positive_inverse(C);
      Matrix3       in;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          in(i, j) = F(in_plane[i], in_plane[j]);
      return in.inverse();
    }
  } // namespace



  Laminate::Laminate(const std::vector<Lamina> &laminae, const TransverseShear rule)
  {
    if (laminae.empty())
      throw std::invalid_argument("a laminate needs a ply");
    for (const Lamina &lamina : laminae)
      {
        if (!(lamina.thickness > 0))
          throw std::invalid_argument("a ply needs a thickness above zero");
        if (!is_positive_definite(lamina.stiffness))
          throw std::invalid_argument("the stiffness of a ply's material is not positive definite");
        thickness += lamina.thickness;
      }
    double z = -thickness / 2;
    for (const Lamina &lamina : laminae)
      {
        const double c = std::cos(lamina.angle), s = std::sin(lamina.angle), t = lamina.thickness;
        Layer        layer;
        layer.axes << c, -s, 0, s, c, 0, 0, 0, 1;
        layer.stiffness = elasticity::turned(lamina.stiffness, layer.axes);
        layer.reduced   = reduced_stiffness(layer.stiffness);
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
            layer.shear(i, j) = layer.stiffness(transverse[i], transverse[j]);
        layer.density = lamina.density;
        layer.bottom  = z;
        z += t;
        layer.top = z;
        layers.push_back(layer);
        const double middle = z - t / 2;
        mass += lamina.density * t;
        mass_moment += lamina.density * t * middle;
        rotary_inertia += lamina.density * (t * middle * middle + t * t * t / 12);
      }
    find_membrane_and_bending();
    find_shear();
    if (rule == TransverseShear::asymptotic)
      find_asymptotic_shear();
  }



  void
  Laminate::find_membrane_and_bending()
  {
    // the warping gives each point the stresses of σ₃₃ = σ₁₃ = σ₂₃ = 0, so that its energy is that of the reduced
    // stiffness
    ABD.setZero();
    for (const Layer &layer : layers)
      {
        const double a = layer.bottom, b = layer.top, z1 = (b * b - a * a) / 2, z2 = (b * b * b - a * a * a) / 3;
        ABD.topLeftCorner<3, 3>() += (b - a) * layer.reduced;
        ABD.topRightCorner<3, 3>() += z1 * layer.reduced;
        ABD.bottomLeftCorner<3, 3>() += z1 * layer.reduced;
        ABD.bottomRightCorner<3, 3>() += z2 * layer.reduced;
      }
    const Matrix6 compliance = positive_inverse(ABD);
    unit_moments.col(0)      = compliance.col(3);
    unit_moments.col(1)      = compliance.col(5);
  }



  Eigen::Matrix2d
  Laminate::shear_stresses(const Layer &layer, const double z) const
  {
    const double a = layer.bottom, z0 = z - a, z1 = (z * z - a * a) / 2;
    return layer.f_at_bottom -
           by_shear_force(layer.reduced * (z0 * unit_moments.topRows<3>() + z1 * unit_moments.bottomRows<3>()));
  }



  Laminate::Integrals
  Laminate::integrals(const Layer &layer, const double z) const
  {
    const double a = layer.bottom, h = z - a, z1 = h * (z + a) / 2, z11 = h * h * (z + 2 * a) / 6;
    Integrals    result = layer.below;
    result.f +=
      h * layer.f_at_bottom -
      by_shear_force(layer.reduced * (h * h / 2 * unit_moments.topRows<3>() + z11 * unit_moments.bottomRows<3>()));
    result.stiffness += h * layer.reduced;
    result.moment += z1 * layer.reduced;
    result.mass += mass > 0 ? h * layer.density / mass : h / thickness;
    return result;
  }



  void
  Laminate::find_shear()
  {
    // stresses f Q by equilibrium, σ_a3,3 = −σ_ab,b; the flexibility is that of their energy, ∫ fᵀ G⁻¹ f dz
    // f is quadratic in z, the integrand of fourth order: three Gauss points are exact
    const double    point[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight[3] = {5. / 18, 8. / 18, 5. / 18};
    Eigen::Matrix2d compliance = Eigen::Matrix2d::Zero(), f = Eigen::Matrix2d::Zero();
    for (Layer &layer : layers)
      {
        layer.f_at_bottom = f;
        const double h    = layer.top - layer.bottom;
        for (int g = 0; g < 3; ++g)
          {
            const Eigen::Matrix2d at = shear_stresses(layer, layer.bottom + h * (1 + point[g]) / 2);
            compliance += weight[g] * h * at.transpose() * layer.shear.inverse() * at;
          }
        f = shear_stresses(layer, layer.top);
      }
    shear = compliance.inverse();

    warping << warping_along(0), warping_along(1);

    Integrals below;
    for (Layer &layer : layers)
      {
        layer.below = below;
        below       = integrals(layer, layer.top);
      }
  }



  double
  Laminate::warping_along(const unsigned int alpha) const
  {
    const double point[3]  = {(1 - std::sqrt(0.6)) / 2, 0.5, (1 + std::sqrt(0.6)) / 2},
                 weight[3] = {5. / 18, 8. / 18, 5. / 18};
    // ∫E dz, ∫E z dz, and of the warping w from the bottom on ∫E w dz; E the stiffness along α
    const double of_shear = shear.inverse()(alpha, alpha);
    double       whole = 0, first = 0, warped = 0, w = 0;
    for (const Layer &layer : layers)
      {
        const double h = layer.top - layer.bottom, E = layer.reduced(2 * alpha, 2 * alpha),
                     g          = layer.shear(alpha, alpha);
        const auto warping_over = [&](const double height) { // of f/g, quadratic in z
          double sum = 0;
          for (int k = 0; k < 3; ++k)
            sum += weight[k] * height * shear_stresses(layer, layer.bottom + point[k] * height)(alpha, alpha) / g;
          return sum;
        };
        whole += h * E;
        first += h * E * (layer.top + layer.bottom) / 2;
        for (int k = 0; k < 3; ++k)
          warped += weight[k] * h * E * (w + warping_over(point[k] * h));
        w += warping_over(h);
      }
    // less the turn, which the shear angle of the plate is, and the shift that leaves no force
    const double neutral = first / whole, mean = warped / whole, half = thickness / 2;
    const double below = -mean + of_shear * (half + neutral), above = w - mean - of_shear * (half - neutral);
    return std::max(std::abs(below / (half + neutral)), std::abs(above / (half - neutral))) / of_shear;
  }



  Matrix3
  Laminate::free_bending() const
  {
    const Matrix3 B = ABD.topRightCorner<3, 3>(), A = ABD.topLeftCorner<3, 3>();
    return ABD.bottomRightCorner<3, 3>() - B.transpose() * A.inverse() * B;
  }



  std::array<double, 2>
  Laminate::heights(const unsigned int index) const
  {
    return {{layers.at(index).bottom, layers.at(index).top}};
  }



  Vector6
  Laminate::stress(const unsigned int index, const double z, const Vector6 &strains, const Eigen::Vector2d &Q) const
  {
    AssertIndexRange(index, layers.size());
    const Layer &layer = layers[index];
    Assert(layer.bottom - 1e-9 * thickness <= z && z <= layer.top + 1e-9 * thickness,
           dealii::ExcMessage("A height in another layer."));
    const Vector3         plane = layer.reduced * (strains.head<3>() + z * strains.tail<3>());
    const Eigen::Vector2d tau   = shear_stresses(layer, z) * Q;
    Vector6               s     = Vector6::Zero();
    for (int i = 0; i < 3; ++i)
      s(in_plane[i]) = plane(i);
    for (int i = 0; i < 2; ++i)
      s(transverse[i]) = tau(i);
    return s;
  }



  void
  Laminate::Across::balance(const Vector3 &N)
  {
    const double divergence = N.dot(curvature) + inertia - bottom + top;
    shear_gradient += 0.5 * (divergence - shear_gradient.trace()) * Eigen::Matrix2d::Identity();
  }



  double
  Laminate::stress_across(const unsigned int index, const double z, const Vector6 &strains, const Across &across) const
  {
    AssertIndexRange(index, layers.size());
    const Integrals below = integrals(layers[index], z);
    return -across.bottom - below.f.cwiseProduct(across.shear_gradient).sum() +
           across.curvature.dot(below.stiffness * strains.head<3>() + below.moment * strains.tail<3>()) +
           below.mass * across.inertia;
  }



  Vector6
  Laminate::stress_in_material(const unsigned int index, const Vector6 &stress) const
  {
    return elasticity::turn_of_stress(layers.at(index).axes.transpose()) * stress;
  }
} // namespace samara
