// Springs, dampers and stops of a joint, and the forces along its motions: terms of its coordinates.

#include <samara/joints/joint.h>
#include <samara/model/strain_rows.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  /** The springs, dampers and stops of the motions in use. */
  class Joint::Springs : public EvaluatedDeformation<Joint::Springs>
  {
  public:
    explicit Springs(const Joint &joint)
      : used(joint.used)
      , stops(joint.stops)
      , block(joint.block)
    {}

    unsigned int
    n_strains() const override
    {
      return used.size() + stops.size();
    }
    void   strain_rates(const Point<double> &point, double *rates) const override;
    double strain_energy(const double *e) const override;
    bool   is_viscous() const override;
    void   tangent(const Point<double> &point, SparseMatrix &K) const override;
    void   damping(const Point<double> &point, SparseMatrix &C) const override;
    void   strain_rows(const Point<double> &point, StrainRows &rows) const override;

    std::unique_ptr<LinearStrains> linear_strains() const override;

    template <typename Number>
    void strains_at(const Point<Number> &point, Number *e) const;
    template <typename Number>
    void stresses_of(const Number *e, const Number *rates, Number *stress) const;
    template <typename Number>
    void residual_at(const Point<Number> &point, Number *r) const;

    /** Whether there is any. */
    bool are_any() const;

  private:
    /** Stiffnesses or viscosities of the springs, and those of stops that are touched. */
    void
    add(const Point<double> &point, double FreeMotion::*of_motion, double ContactLaw::*of_stop, SparseMatrix &A) const;
    const std::vector<FreeMotion *> &used;
    const std::vector<Stop>         &stops;
    const Block                     &block;

    class Linear;

    const FreeMotion &
    motion_of(const Stop &stop) const
    {
      return *used[stop.motion];
    }

    /** Whether the stop is touched, as a factor. */
    template <typename Number>
    double
    touches(const Point<Number> &point, const Stop &stop) const
    {
      const double gap = stop.side * (std::real(point.coordinates[motion_of(stop).coordinate]) - stop.place);
      return point.stops && gap > 0 ? 1. : 0.;
    }
  };



  /** B of them: the rates of the coordinates, once more for each stop that is touched. */
  class Joint::Springs::Linear : public LinearStrains
  {
  public:
    explicit Linear(const Springs &springs)
      : springs(springs)
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
      springs.strain_rates(at, e);
    }

    void
    add_forces(const double *stress, double *r) const override
    {
      for (unsigned int i = 0; i < springs.used.size(); ++i)
        r[springs.block.row(12 + i)] += *stress++;
      for (const auto &stop : springs.stops)
        r[springs.block.row(12 + stop.motion)] += springs.touches(point, stop) * *stress++;
    }

  private:
    const Springs &springs;
    Point<double>  point;
  };



  std::unique_ptr<LinearStrains>
  Joint::Springs::linear_strains() const
  {
    return std::make_unique<Linear>(*this);
  }



  bool
  Joint::Springs::are_any() const
  {
    return !stops.empty() ||
           std::any_of(used.begin(), used.end(), [](const FreeMotion *m) { return m->spring != 0 || m->damper != 0; });
  }



  template <typename Number>
  void
  Joint::Springs::strains_at(const Point<Number> &point, Number *e) const
  {
    for (const auto *m : used)
      *e++ = point.coordinates[m->coordinate] - m->rest;
    for (const auto &s : stops)
      *e++ = touches(point, s) * (point.coordinates[motion_of(s).coordinate] - s.place);
  }



  void
  Joint::Springs::strain_rates(const Point<double> &point, double *rates) const
  {
    for (const auto *m : used)
      *rates++ = point.rates[m->coordinate];
    for (const auto &s : stops)
      *rates++ = touches(point, s) * point.rates[motion_of(s).coordinate];
  }



  template <typename Number>
  void
  Joint::Springs::stresses_of(const Number *e, const Number *rates, Number *stress) const
  {
    for (const auto *m : used)
      *stress++ = m->spring * *e++ + m->damper * *rates++;
    for (const auto &s : stops)
      *stress++ = motion_of(s).stop_law.stiffness * *e++ + motion_of(s).stop_law.damping * *rates++;
  }



  template <typename Number>
  void
  Joint::Springs::residual_at(const Point<Number> &point, Number *r) const
  {
    const Number *stress = point.stress + first_strain;
    for (unsigned int i = 0; i < used.size(); ++i)
      r[block.row(12 + i)] += *stress++;
    for (const auto &s : stops)
      {
        // a damper that would pull is cut
        if (s.side * std::real(*stress) > 0)
          r[block.row(12 + s.motion)] += touches(point, s) * *stress;
        ++stress;
      }
  }



  double
  Joint::Springs::strain_energy(const double *e) const
  {
    double twice = 0;
    for (const auto *m : used)
      twice += m->spring * std::pow(*e++, 2);
    for (const auto &s : stops)
      twice += motion_of(s).stop_law.stiffness * std::pow(*e++, 2);
    return 0.5 * twice;
  }



  void
  Joint::Springs::strain_rows(const Point<double> &point, StrainRows &strain_rows) const
  {
    using One           = Eigen::Matrix<double, 1, 1>;
    unsigned int strain = first_strain;
    const auto   add    = [&](const unsigned int motion, const double k, const double c, const double on) {
      strain_rows.add_point(strain++, 1., One(k), One(c));
      strain_rows.begin_row();
      strain_rows.add_entry(block.row(12 + motion), on);
    };
    for (unsigned int i = 0; i < used.size(); ++i)
      add(i, used[i]->spring, used[i]->damper, 1.);
    for (const auto &s : stops)
      add(s.motion, motion_of(s).stop_law.stiffness, motion_of(s).stop_law.damping, touches(point, s));
  }



  void
  Joint::Springs::add(const Point<double> &point,
                      double FreeMotion::*of_motion,
                      double ContactLaw::*of_stop,
                      SparseMatrix       &A) const
  {
    if (!point.material)
      return;
    for (unsigned int i = 0; i < used.size(); ++i)
      block.add_entry(12 + i, 12 + i, used[i]->*of_motion, A);
    for (const auto &s : stops)
      block.add_entry(12 + s.motion, 12 + s.motion, touches(point, s) * motion_of(s).stop_law.*of_stop, A);
  }



  void
  Joint::Springs::tangent(const Point<double> &point, SparseMatrix &K) const
  {
    add(point, &FreeMotion::spring, &ContactLaw::stiffness, K);
  }



  void
  Joint::Springs::damping(const Point<double> &point, SparseMatrix &C) const
  {
    add(point, &FreeMotion::damper, &ContactLaw::damping, C);
  }



  bool
  Joint::Springs::is_viscous() const
  {
    return std::any_of(used.begin(), used.end(), [](const FreeMotion *m) {
      return m->damper != 0 ||
             ((m->has_lower_stop || m->has_upper_stop) && m->stop_law.is_linear() && m->stop_law.damping != 0);
    });
  }



  /** Forces and moments along and about the motions in use. */
  class Joint::Actuators : public Evaluated<Joint::Actuators, Force>
  {
  public:
    explicit Actuators(const Joint &joint)
      : used(joint.used)
      , block(joint.block)
    {}

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      for (unsigned int i = 0; i < used.size(); ++i)
        r[block.row(12 + i)] -= point.factor * (used[i]->response ? (*used[i]->response)(point) :
                                                                    Number(used[i]->force.of_time()(point.time)));
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      for (const auto *m : used)
        if (m->response)
          m->response->add_tangent(point, Eigen::VectorXd::Constant(1, -point.factor), K);
    }

    void
    damping(const Point<double> &point, SparseMatrix &C) const override
    {
      for (const auto *m : used)
        if (m->response)
          m->response->add_damping(point, Eigen::VectorXd::Constant(1, -point.factor), C);
    }

    void
    pieces(const Point<double> &point, std::vector<double> &result) const override
    {
      for (const auto *m : used)
        if (m->response)
          m->response->pieces(point, result);
    }

    double
    next_corner(const double from, const double to) const override
    {
      double corner = std::numeric_limits<double>::infinity();
      for (const auto *m : used)
        corner = std::min(corner, m->force.next_corner(from, to));
      return corner;
    }

  private:
    const std::vector<FreeMotion *> &used;
    const Block                     &block;
  };



  /** The forces of nonlinear springs. In time steps Layout::nonlinear_springs add to them what keeps their energy. */
  class Joint::NonlinearSprings : public Evaluated<Joint::NonlinearSprings, Force>
  {
  public:
    explicit NonlinearSprings(const Joint &joint)
      : used(joint.used)
      , block(joint.block)
    {}

    template <typename Number>
    void
    residual_at(const Point<Number> &point, Number *r) const
    {
      for (unsigned int i = 0; i < used.size(); ++i)
        if (const SpringLaw *const law = used[i]->nonlinear_spring.get())
          {
            const Number d  = stretch(*used[i], point);
            const double at = std::real(d);
            r[block.row(12 + i)] += law->force(at);
            if constexpr (!std::is_same<Number, double>::value) // along imaginary steps, see Response
              r[block.row(12 + i)] += law->stiffness(at) * (d - at);
          }
    }

    void
    tangent(const Point<double> &point, SparseMatrix &K) const override
    {
      for (unsigned int i = 0; i < used.size(); ++i)
        if (const SpringLaw *const law = used[i]->nonlinear_spring.get())
          block.add_entry(12 + i, 12 + i, law->stiffness(stretch(*used[i], point)), K);
    }

    bool
    has_potential() const override
    {
      return true;
    }

    double
    potential_energy(const Point<double> &point) const override
    {
      double sum = 0;
      for (const auto *m : used)
        if (m->nonlinear_spring)
          sum += m->nonlinear_spring->energy(stretch(*m, point));
      return sum;
    }

    void
    pieces(const Point<double> &point, std::vector<double> &result) const override
    {
      std::vector<double> own;
      for (const auto *m : used)
        if (m->nonlinear_spring)
          {
            const double variables[] = {point.time, stretch(*m, point)};
            m->spring_law.pieces(variables, own);
            result.insert(result.end(), own.begin(), own.end());
          }
    }

  private:
    const std::vector<FreeMotion *> &used;
    const Block                     &block;

    template <typename Number>
    static Number
    stretch(const FreeMotion &m, const Point<Number> &point)
    {
      return point.coordinates[m.coordinate] + m.reference;
    }
  };



  void
  Joint::add_nonlinear_springs(Layout &layout)
  {
    bool are_any = false;
    for (const auto *m : used)
      if (m->nonlinear_spring)
        {
          are_any = true;
          layout.nonlinear_springs.push_back(
            {static_cast<unsigned int>(m->coordinate), m->reference, m->nonlinear_spring.get()});
        }
    if (!are_any)
      return;
    nonlinear_springs = std::make_unique<NonlinearSprings>(*this);
    layout.add(*this, *nonlinear_springs);
  }



  void
  Joint::add_springs(Layout &layout)
  {
    add_nonlinear_springs(layout);
    if (auto given = std::make_unique<Springs>(*this); given->are_any())
      {
        layout.add(*this, *given);
        springs = std::move(given);
      }
    if (std::any_of(used.begin(), used.end(), [](const FreeMotion *m) { return !m->force.is_zero(); }))
      {
        for (auto *m : used)
          if (m->response)
            m->response->connect(layout, {{}, {static_cast<unsigned int>(m->coordinate)}, {}, {}});
        actuators = std::make_unique<Actuators>(*this);
        layout.add(*this, *actuators);
      }
  }
} // namespace samara
