// The loops over the terms of the equations.

#include <samara/model/algebraic_states.h>
#include <samara/model/drawing.h>
#include <samara/model/initial_motion.h>
#include <samara/model/system.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace samara
{
  namespace
  {
    const RelativeMotions *
    motions_of(const Item &item)
    {
      return dynamic_cast<const RelativeMotions *>(&item);
    }



    template <typename Terms, typename Number>
    void
    add_residuals(const Terms &terms, const Point<Number> &point, Number *const r)
    {
      for (const auto *term : terms)
        term->residual(point, r);
    }
  } // namespace



  bool
  System::is_in(const Deformation &deformation, const Part part) const
  {
    if (part == Part::all)
      return true;
    // beams have no strain where their nodes move as one rigid body, and some wherever they do not
    const auto *const motions = motions_of(*deformation.item);
    return motions == nullptr || motions->rigid_nodes().empty();
  }



  template <typename Number>
  void
  System::strains(const Point<Number> &point, Number *const e) const
  {
    for (const auto *d : deformations)
      d->strains(point, e + d->first_strain);
  }



  void
  System::strain_rates(const Point<double> &point, double *const rates) const
  {
    for (const auto *d : deformations)
      d->strain_rates(point, rates + d->first_strain);
  }



  template <typename Number>
  void
  System::stresses(const Number *const e, const Number *const rates, Number *const stress) const
  {
    for (const auto *d : deformations)
      d->stresses(e + d->first_strain, rates + d->first_strain, stress + d->first_strain);
  }



  template <typename Number>
  void
  System::add_terms(const Point<Number> &point, Number *const r) const
  {
    add_bonds(point, r);
    add_loads_and_states(point, r);
  }



  template <typename Number>
  void
  System::add_bonds(const Point<Number> &point, Number *const r) const
  {
    add_residuals(deformations, point, r);
    add_residuals(layout.constraints, point, r);
  }



  template <typename Number>
  void
  System::add_loads_and_states(const Point<Number> &point, Number *const r) const
  {
    add_residuals(layout.forces, point, r);
    add_residuals(layout.state_equations, point, r);
  }



  void
  System::add_bonds_and_rates(const Point<double> &point,
                              double *const        r,
                              double *const        strain_rates,
                              double *const        constraint_rates) const
  {
    for (const auto *d : deformations)
      d->strain_rates_and_residual(point, strain_rates + d->first_strain, r);
    std::fill_n(constraint_rates, layout.n_multipliers, 0.);
    for (const auto *c : layout.constraints)
      c->forces_and_rates(point, r, constraint_rates);
  }



  void
  System::add_loads(const Point<double> &point, double *const r, const bool with_potential) const
  {
    for (const auto *f : layout.forces)
      if (with_potential || !f->has_potential())
        f->residual(point, r);
  }



  void
  System::add_load(const unsigned int i, const Point<double> &point, double *const r) const
  {
    layout.forces[i]->residual(point, r);
  }



  void
  System::add_constraints(const Point<double> &point, double *const r) const
  {
    for (const auto *c : layout.constraints)
      c->residual(point, r);
  }



  void
  System::add_gaps(const Point<double> &point, double *const r) const
  {
    for (const auto *c : layout.constraints)
      c->constraints(point, r);
  }



  void
  System::constraint_rates(const Point<double> &point, double *const rates) const
  {
    std::fill_n(rates, layout.n_multipliers, 0.);
    for (const auto *c : layout.constraints)
      c->rates(point, rates);
  }



  void
  System::constraint_time_rates(const Point<double> &point, double *const rates) const
  {
    std::fill_n(rates, layout.n_multipliers, 0.);
    for (const auto *c : layout.constraints)
      c->time_rates(point, rates);
  }



  void
  System::constraint_second_rates(const Point<double> &point, double *const rates) const
  {
    std::fill_n(rates, layout.n_multipliers, 0.);
    for (const auto *c : layout.constraints)
      c->second_rates(point, rates);
  }



  void
  System::state_rates(const Point<double> &point, double *const rates) const
  {
    if (layout.n_states == 0)
      return;
    thread_local std::vector<double> r;
    r.assign(size() + 6, 0.);
    for (const auto *z : layout.state_equations)
      z->residual(point, r.data());
    for (unsigned int i = 0; i < layout.n_states; ++i)
      rates[i] = -r[layout.of_state(i)];
  }



  void
  System::find_state_rates(State &state) const
  {
    state_rates(state.point(), state.state_rates.data());
  }



  void
  System::add_tangent(const Point<double> &point, SparseMatrix &K, const Part part) const
  {
    for (const auto *d : layout.deformations)
      if (is_in(*d, part))
        d->tangent(point, K);
    for (const auto *c : layout.constraints)
      c->tangent(point, K);
    for (const auto *f : layout.forces)
      f->tangent(point, K);
    for (const auto *z : layout.state_equations)
      z->tangent(point, K);
  }



  void
  System::add_damping(const Point<double> &point, SparseMatrix &C) const
  {
    for (const auto *d : layout.deformations)
      d->damping(point, C);
    for (const auto *c : layout.constraints)
      c->damping(point, C);
    for (const auto *f : layout.forces)
      f->damping(point, C);
    for (const auto *z : layout.state_equations)
      z->damping(point, C);
  }



  void
  System::add_state_damping(SparseMatrix &C) const
  {
    for (unsigned int i = 0; i < layout.n_states; ++i)
      C.values[C.pattern->position(layout.of_state(i), layout.of_state(i))] += 1.;
    for (const unsigned int i : algebraic_states(model))
      C.values[C.pattern->position(layout.of_state(i), layout.of_state(i))] -= 1.;
  }



  void
  System::add_constraint_tangent(const Point<double> &point, SparseMatrix &K) const
  {
    for (const auto *c : layout.constraints)
      c->tangent(point, K);
  }



  double
  System::strain_energy(const double *const e, const Part part) const
  {
    double energy = 0;
    for (const auto *d : layout.deformations)
      if (is_in(*d, part))
        energy += d->strain_energy(e + d->first_strain);
    return energy;
  }



  void
  System::subtract_powers(const double *const              stress,
                          const double *const              rates,
                          const std::vector<unsigned int> &set_of_strain,
                          double *const                    powers) const
  {
    for (const auto *d : layout.deformations)
      if (d->n_strains() > 0)
        powers[set_of_strain[d->first_strain]] -= d->power(stress + d->first_strain, rates + d->first_strain);
  }



  std::vector<unsigned int>
  System::rows_of_strains(const State &state) const
  {
    // stresses without any order: what they do does not cancel everywhere
    std::vector<unsigned int> result(layout.n_strains, size());
    std::vector<double>       stress(layout.n_strains), r(size() + 6);
    for (unsigned int i = 0; i < stress.size(); ++i)
      stress[i] = std::sin(1. + 3. * i);
    Point<double> point = state.point();
    point.stress        = stress.data();
    for (const auto *d : layout.deformations)
      {
        std::fill(r.begin(), r.end(), 0.);
        d->residual(point, r.data());
        const auto largest = std::max_element(r.begin(), r.end() - 6, [](const double a, const double b) {
          return std::abs(a) < std::abs(b);
        });
        if (largest != r.end() - 6 && *largest != 0)
          std::fill_n(result.begin() + d->first_strain, d->n_strains(), largest - r.begin());
      }
    return result;
  }



  double
  System::sum_of_powers(const double *const stress, const double *const rates) const
  {
    double sum = 0;
    for (const auto *d : layout.deformations)
      sum += std::abs(d->power(stress + d->first_strain, rates + d->first_strain));
    return sum;
  }



  const Item *
  System::strained(const Point<double> &point, const double bound) const
  {
    std::vector<double> rates;
    for (const auto *d : layout.deformations)
      {
        rates.assign(d->n_strains(), 0.);
        d->strain_rates(point, rates.data());
        if (d->strain_energy(rates.data()) > 0 &&
            std::any_of(rates.begin(), rates.end(), [=](const double rate) { return std::abs(rate) > bound; }))
          return d->item;
      }
    return nullptr;
  }



  double
  System::viscous_power(const double *const rates) const
  {
    thread_local std::vector<double> unstrained, stress;
    double                           sum = 0;
    for (const auto *d : layout.deformations)
      if (d->is_viscous())
        {
          unstrained.assign(d->n_strains(), 0.);
          stress.resize(d->n_strains());
          d->stresses(unstrained.data(), rates + d->first_strain, stress.data());
          sum += d->power(stress.data(), rates + d->first_strain);
        }
    return sum;
  }



  double
  System::potential_energy(const Point<double> &point) const
  {
    double sum = 0;
    for (const auto *f : layout.forces)
      if (f->has_potential())
        sum += f->potential_energy(point);
    return sum;
  }



  double
  System::next_corner(const double from, const double to) const
  {
    double     first = std::numeric_limits<double>::infinity();
    const auto see   = [&](const auto &terms) {
      for (const auto *term : terms)
        first = std::min(first, term->next_corner(from, to));
    };
    see(layout.deformations);
    see(layout.constraints);
    see(layout.forces);
    see(layout.state_equations);
    return first;
  }



  void
  System::pieces(const Point<double> &point, std::vector<double> &result) const
  {
    result.clear();
    for (const auto *c : layout.constraints)
      c->pieces(point, result);
    for (const auto *f : layout.forces)
      f->pieces(point, result);
    for (const auto *z : layout.state_equations)
      z->pieces(point, result);
  }



  namespace
  {
    /** B of all deformations, one after the other. */
    class AllLinearStrains : public LinearStrains
    {
    public:
      explicit AllLinearStrains(const std::vector<const Deformation *> &deformations)
      {
        for (const auto *d : deformations)
          parts.push_back({d->first_strain, d->linear_strains()});
      }

      void
      renew(const Point<double> &point) override
      {
        for (auto &part : parts)
          part.strains->renew(point);
      }

      void
      strains(const double *const y, const double *const rates, double *const e) const override
      {
        for (const auto &part : parts)
          part.strains->strains(y, rates, e + part.first);
      }

      void
      add_forces(const double *const stress, double *const r) const override
      {
        for (const auto &part : parts)
          part.strains->add_forces(stress + part.first, r);
      }

    private:
      struct Part
      {
        unsigned int                   first;
        std::unique_ptr<LinearStrains> strains;
      };
      std::vector<Part> parts;
    };
  } // namespace



  std::unique_ptr<LinearStrains>
  System::linear_strains() const
  {
    return std::make_unique<AllLinearStrains>(deformations);
  }



  StrainRows
  System::strain_rows(const State &state, const Part part) const
  {
    return strain_rows(state.point(), part);
  }



  StrainRows
  System::strain_rows(const Point<double> &point, const Part part) const
  {
    StrainRows rows(size());
    for (const auto *d : layout.deformations)
      if (is_in(*d, part))
        d->strain_rows(point, rows);
    return rows;
  }



  std::vector<RelativeRate>
  System::relative_rates(const double *const q) const
  {
    std::vector<RelativeRate> rates;
    for (const auto &item : model.items)
      if (const auto *const motions = motions_of(*item))
        motions->add_relative_rates(q, rates);
    return rates;
  }



  std::vector<std::vector<unsigned int>>
  System::rigid_nodes() const
  {
    std::vector<std::vector<unsigned int>> groups;
    for (const auto &item : model.items)
      if (const auto *const motions = motions_of(*item))
        if (auto nodes = motions->rigid_nodes(); !nodes.empty())
          groups.push_back(std::move(nodes));
    return groups;
  }



  void
  System::add_initial_velocities(State &state) const
  {
    for (const auto &item : model.items)
      item->add_initial_velocities(state);
    std::map<unsigned int, Vector6> twists;
    for (const auto &item : model.items)
      if (const auto *const motion = dynamic_cast<const InitialMotion *>(item.get()))
        motion->add_velocity_fields(state, twists);
    for (const auto &[node, twist] : twists)
      Eigen::Map<Vector6>(&state.y[6 * node]) += twist;
  }



  Drawing
  System::draw(const State &state, const Drawing::Content content) const
  {
    Drawing drawing(&model, content);
    for (const auto &item : model.items)
      {
        item->draw(state, drawing);
        drawing.items.resize(drawing.n_objects(), item.get());
      }
    return drawing;
  }



  template void System::strains(const Point<double> &, double *) const;
  template void System::strains(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void System::stresses(const double *, const double *, double *) const;
  template void
  System::stresses(const std::complex<double> *, const std::complex<double> *, std::complex<double> *) const;
  template void System::add_terms(const Point<double> &, double *) const;
  template void System::add_terms(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void System::add_bonds(const Point<double> &, double *) const;
  template void System::add_bonds(const Point<std::complex<double>> &, std::complex<double> *) const;
  template void System::add_loads_and_states(const Point<double> &, double *) const;
  template void System::add_loads_and_states(const Point<std::complex<double>> &, std::complex<double> *) const;
} // namespace samara
