#include <samara/cosserat/tension_torsion.h>

namespace samara
{
  namespace
  {
    /** Work space for six numbers a point, kept so that nothing is allocated twice. */
    template <typename Number, int which>
    std::vector<Number> &
    six_a_point(const std::size_t n_points)
    {
      static thread_local std::vector<Number> values;
      values.resize(6 * n_points);
      return values;
    }
  } // namespace



  TensionTorsion::TensionTorsion(const Cosserat<1> &beam, const std::vector<Trapeze> &of_material)
    : beam(beam)
    , of_material(of_material)
  {
    for (const auto &t : of_material)
      ratios.push_back(t.is_there() ? Vector6(t.coupling / t.stiffness) : Vector6(Vector6::Zero()));
  }



  void
  TensionTorsion::add_products(std::vector<StrainProduct> &products) const
  {
    for (unsigned int first = first_strain; first < first_strain + n_strains(); first += n)
      products.push_back({first + of_twist, first + of_rest, first + of_both});
  }



  unsigned int
  TensionTorsion::n_strains() const
  {
    return n * beam.points.size();
  }



  const Trapeze &
  TensionTorsion::trapeze(const unsigned int g) const
  {
    return of_material[beam.points[g].material];
  }



  const Vector6 &
  TensionTorsion::ratio(const unsigned int g) const
  {
    return ratios[beam.points[g].material];
  }



  // κ, γ and f = ½ κ² + γ, with the energy ½ q f²: doc/theory/cross_section.md, tension and torsion
  template <typename Number>
  void
  TensionTorsion::strains_at(const Point<Number> &point, Number *e) const
  {
    auto &own = six_a_point<Number, 0>(beam.points.size());
    beam.strains(point, own.data());
    for (unsigned int g = 0; g < beam.points.size(); ++g)
      {
        Number *const to = e + n * g;
        to[of_twist]     = own[6 * g + 3];
        to[of_rest]      = Number(0);
        for (unsigned int i = 0; i < 6; ++i)
          to[of_rest] += ratio(g)(i) * own[6 * g + i];
        to[of_both] = 0.5 * to[of_twist] * to[of_twist] + to[of_rest];
      }
  }



  void
  TensionTorsion::strain_rates(const Point<double> &point, double *rates) const
  {
    auto &own = six_a_point<double, 0>(beam.points.size()), &own_rates = six_a_point<double, 1>(beam.points.size());
    beam.strains(point, own.data());
    beam.strain_rates(point, own_rates.data());
    for (unsigned int g = 0; g < beam.points.size(); ++g)
      {
        double *const to = rates + n * g;
        to[of_twist]     = own_rates[6 * g + 3];
        to[of_rest]      = ratio(g).dot(Eigen::Map<const Vector6>(&own_rates[6 * g]));
        to[of_both]      = own[6 * g + 3] * to[of_twist] + to[of_rest];
      }
  }



  // q f on γ, and κ times as much on κ; f itself is no strain of its own, and has none
  template <typename Number>
  void
  TensionTorsion::stresses_of(const Number *e, const Number *, Number *stress) const
  {
    for (unsigned int g = 0; g < beam.points.size(); ++g)
      {
        const Number s           = trapeze(g).stiffness * e[n * g + of_both];
        stress[n * g + of_twist] = s * e[n * g + of_twist];
        stress[n * g + of_rest]  = s;
        stress[n * g + of_both]  = Number(0);
      }
  }



  template <typename Number>
  const std::vector<Number> &
  TensionTorsion::all_section_forces(const Number *stress) const
  {
    auto &forces = six_a_point<Number, 2>(beam.points.size());
    for (unsigned int g = 0; g < beam.points.size(); ++g)
      {
        for (unsigned int i = 0; i < 6; ++i)
          forces[6 * g + i] = ratio(g)(i) * stress[first_strain + n * g + of_rest];
        forces[6 * g + 3] += stress[first_strain + n * g + of_twist];
      }
    return forces;
  }



  template <typename Number>
  void
  TensionTorsion::residual_at(const Point<Number> &point, Number *r) const
  {
    Point<Number> at = point;
    at.stress        = all_section_forces(point.stress).data() - beam.first_strain;
    beam.residual(at, r);
  }



  void
  TensionTorsion::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    static thread_local std::vector<Matrix6> C;
    C.clear();
    if (point.material)
      {
        auto &own = six_a_point<double, 0>(beam.points.size());
        beam.strains(point, own.data());
        for (unsigned int g = 0; g < beam.points.size(); ++g)
          {
            // ∂²(½ q f²)/∂e² = q b bᵀ + q f on the twist, b = ∂f/∂e
            const Vector6 b = own[6 * g + 3] * Vector6::Unit(3) + ratio(g);
            C.push_back(trapeze(g).stiffness * b * b.transpose());
            C.back()(3, 3) += point.stress[first_strain + n * g + of_rest];
          }
      }
    beam.add_tangent(point, point.material ? C.data() : nullptr, all_section_forces(point.stress).data(), K);
  }



  void
  TensionTorsion::strain_rows(const Point<double> &point, StrainRows &rows) const
  {
    auto &own = six_a_point<double, 0>(beam.points.size());
    beam.strains(point, own.data());
    beam.for_strain_matrices(point, [&](const unsigned int g, const Block &block, const auto &B) {
      // ∂²(½ q f²) by κ and γ
      const unsigned int first = first_strain + n * g;
      const double       q = trapeze(g).stiffness, twist = own[6 * g + 3];
      Eigen::Matrix2d    C;
      C << q * twist * twist + point.stress[first + of_rest], q * twist, q * twist, q;
      rows.add_point(first, beam.points[g].weight, C, Eigen::Matrix2d::Zero().eval());
      rows.begin_row();
      for (int j = 0; j < B.cols(); ++j)
        rows.add_entry(block.row(j), B(3, j));
      rows.begin_row();
      for (int j = 0; j < B.cols(); ++j)
        rows.add_entry(block.row(j), ratio(g).dot(B.col(j)));
    });
  }



  double
  TensionTorsion::strain_energy(const double *e) const
  {
    double energy = 0;
    for (unsigned int g = 0; g < beam.points.size(); ++g)
      energy += 0.5 * beam.points[g].weight * trapeze(g).stiffness * e[n * g + of_both] * e[n * g + of_both];
    return energy;
  }



  double
  TensionTorsion::power(const double *stress, const double *rates) const
  {
    double sum = 0;
    for (unsigned int g = 0; g < beam.points.size(); ++g)
      sum += beam.points[g].weight *
             (stress[n * g + of_twist] * rates[n * g + of_twist] + stress[n * g + of_rest] * rates[n * g + of_rest]);
    return sum;
  }



  Vector6
  TensionTorsion::section_forces(const unsigned int g, const double *stress) const
  {
    const double *const own = stress + first_strain + n * g;
    return ratio(g) * own[of_rest] + own[of_twist] * Vector6::Unit(3);
  }



  Vector6
  TensionTorsion::helical_forces(const unsigned int g, const double *stress, const double twist) const
  {
    return stress[first_strain + n * g + of_twist] * Vector6::Unit(3) + 0.5 * twist * twist * trapeze(g).coupling;
  }



  template class Evaluated<TensionTorsion, Deformation>;
  template class EvaluatedDeformation<TensionTorsion>;
} // namespace samara
