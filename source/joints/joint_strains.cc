// Springs, dampers and stops of a joint: the strains of its coordinates.

#include <samara/joints/joint.h>
#include <samara/model/strain_rows.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  unsigned int
  Joint::n_strains() const
  {
    return used.size() + stops.size();
  }



  template <typename Number>
  double
  Joint::touches(const Point<Number> &point, const unsigned int i) const
  {
    const Stop  &s   = stops[i];
    const double gap = s.side * (std::real(point.coordinates[used[s.motion]->coordinate]) - s.place);
    return point.stops && gap > 0 ? 1. : 0.;
  }



  template <typename Number>
  void
  Joint::strains_at(const Point<Number> &point, Number *e) const
  {
    for (unsigned int i = 0; i < used.size(); ++i)
      e[i] = point.coordinates[used[i]->coordinate] - used[i]->rest;
    for (unsigned int i = 0; i < stops.size(); ++i)
      e[used.size() + i] = touches(point, i) * (point.coordinates[used[stops[i].motion]->coordinate] - stops[i].place);
  }



  void
  Joint::strain_rates(const Point<double> &point, double *rates) const
  {
    for (unsigned int i = 0; i < used.size(); ++i)
      rates[i] = point.rates[used[i]->coordinate];
    for (unsigned int i = 0; i < stops.size(); ++i)
      rates[used.size() + i] = touches(point, i) * point.rates[used[stops[i].motion]->coordinate];
  }



  /** B of a joint: the rates of its coordinates, once more for each stop that is touched. */
  class Joint::Strains : public LinearStrains
  {
  public:
    explicit Strains(const Joint &joint)
      : joint(joint)
    {}

    void
    renew(const Point<double> &p) override
    {
      point = p;
    }

    void
    strains(const double *, const double *rates, double *e) const override
    {
      Point<double> at = point;
      at.rates         = rates;
      joint.strain_rates(at, e);
    }

    void
    add_forces(const double *stress, double *r) const override
    {
      for (unsigned int i = 0; i < joint.used.size(); ++i)
        r[joint.block.row(12 + i)] += stress[i];
      for (unsigned int i = 0; i < joint.stops.size(); ++i)
        r[joint.block.row(12 + joint.stops[i].motion)] += joint.touches(point, i) * stress[joint.used.size() + i];
    }

  private:
    const Joint  &joint;
    Point<double> point;
  };



  std::unique_ptr<LinearStrains>
  Joint::linear_strains() const
  {
    return std::make_unique<Strains>(*this);
  }



  template <typename Number>
  void
  Joint::stresses_of(const Number *e, const Number *rates, Number *stress) const
  {
    for (unsigned int i = 0; i < used.size(); ++i)
      stress[i] = used[i]->spring * e[i] + used[i]->damper * rates[i];
    for (unsigned int i = 0; i < stops.size(); ++i)
      {
        const FreeMotion  &m = *used[stops[i].motion];
        const unsigned int k = used.size() + i;
        stress[k]            = m.stop_stiffness * e[k] + m.stop_damping * rates[k];
      }
  }



  double
  Joint::strain_energy(const double *e) const
  {
    double energy = 0;
    for (unsigned int i = 0; i < used.size(); ++i)
      energy += 0.5 * used[i]->spring * e[i] * e[i];
    for (unsigned int i = 0; i < stops.size(); ++i)
      energy += 0.5 * used[stops[i].motion]->stop_stiffness * std::pow(e[used.size() + i], 2);
    return energy;
  }



  void
  Joint::strain_rows(const Point<double> &point, StrainRows &strain_rows) const
  {
    using One = Eigen::Matrix<double, 1, 1>;
    const auto add =
      [&](const unsigned int i, const unsigned int motion, const double k, const double c, const double on) {
        strain_rows.add_point(first_strain + i, 1., One(k), One(c));
        strain_rows.begin_row();
        strain_rows.add_entry(block.row(12 + motion), on);
      };
    for (unsigned int i = 0; i < used.size(); ++i)
      add(i, i, used[i]->spring, used[i]->damper, 1.);
    for (unsigned int i = 0; i < stops.size(); ++i)
      {
        const FreeMotion &m = *used[stops[i].motion];
        add(used.size() + i, stops[i].motion, m.stop_stiffness, m.stop_damping, touches(point, i));
      }
  }



  void
  Joint::damping(const Point<double> &point, SparseMatrix &C) const
  {
    if (!point.material)
      return;
    for (unsigned int i = 0; i < used.size(); ++i)
      block.add_entry(12 + i, 12 + i, used[i]->damper, C);
    for (unsigned int i = 0; i < stops.size(); ++i)
      {
        const unsigned int k = 12 + stops[i].motion;
        block.add_entry(k, k, touches(point, i) * used[stops[i].motion]->stop_damping, C);
      }
  }



  bool
  Joint::has_damping() const
  {
    return std::any_of(used.begin(), used.end(), [](const FreeMotion *m) {
      return m->damper != 0 || ((m->has_lower_stop || m->has_upper_stop) && m->stop_damping != 0);
    });
  }



  template double Joint::touches(const Point<double> &, unsigned int) const;
  template double Joint::touches(const Point<std::complex<double>> &, unsigned int) const;
  template void   Joint::strains_at(const Point<double> &, double *) const;
  template void   Joint::strains_at(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void   Joint::stresses_of(const double *, const double *, double *) const;
  template void
  Joint::stresses_of(const std::complex<double> *, const std::complex<double> *, std::complex<double> *) const;
} // namespace samara
