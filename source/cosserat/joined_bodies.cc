// The deformations of several bodies as one, so that elements of different bodies fill the lanes.

#include <samara/cosserat/cosserat.h>

#include <algorithm>

namespace samara
{
  namespace
  {
    /** Bodies of one dimension. Their strains stay where they are among those of the layout. */
    template <int dim>
    class JoinedBodies : public Deformation
    {
    public:
      explicit JoinedBodies(const std::vector<const Cosserat<dim> *> &bodies)
        : bodies(bodies)
        , lanes(parts_of(bodies))
      {}

      void
      residual(const Point<double> &point, double *r) const override
      {
        lanes.add_forces(point, point.stress, r);
      }
      void
      residual(const Point<std::complex<double>> &point, std::complex<double> *r) const override
      {
        lanes.add_forces(point, point.stress, r);
      }

      void
      strains(const Point<double> &point, double *e) const override
      {
        lanes.strains(point, e);
      }
      void
      strains(const Point<std::complex<double>> &point, std::complex<double> *e) const override
      {
        lanes.strains(point, e);
      }
      void
      strain_rates(const Point<double> &point, double *rates) const override
      {
        lanes.strain_rates(point, rates);
      }
      void
      strain_rates_and_residual(const Point<double> &point, double *rates, double *r) const override
      {
        lanes.add_forces_and_rates(point, point.stress, r, rates);
      }
      std::unique_ptr<LinearStrains>
      linear_strains() const override
      {
        return lanes.linear_strains();
      }

      void
      stresses(const double *e, const double *rates, double *stress) const override
      {
        stresses_of(e, rates, stress);
      }
      void
      stresses(const std::complex<double> *e,
               const std::complex<double> *rates,
               std::complex<double>       *stress) const override
      {
        stresses_of(e, rates, stress);
      }

      unsigned int
      n_strains() const override
      {
        unsigned int sum = 0;
        for (const auto *body : bodies)
          sum += body->n_strains();
        return sum;
      }
      double
      strain_energy(const double *e) const override
      {
        double sum = 0;
        for (const auto *body : bodies)
          sum += body->strain_energy(e + body->first_strain);
        return sum;
      }

    private:
      std::vector<const Cosserat<dim> *> bodies;
      ElementLanes<dim>                  lanes;

      static std::vector<typename ElementLanes<dim>::Part>
      parts_of(const std::vector<const Cosserat<dim> *> &bodies)
      {
        std::vector<typename ElementLanes<dim>::Part> parts;
        for (const auto *body : bodies)
          parts.push_back({body, body->first_strain});
        return parts;
      }

      template <typename Number>
      void
      stresses_of(const Number *e, const Number *rates, Number *stress) const
      {
        for (const auto *body : bodies)
          body->stresses(e + body->first_strain, rates + body->first_strain, stress + body->first_strain);
      }
    };
  } // namespace



  template <int dim>
  std::unique_ptr<Deformation>
  Cosserat<dim>::joined(std::vector<const Deformation *> &terms) const
  {
    const auto joining = [](const Deformation *term) {
      const auto *const body = dynamic_cast<const Cosserat *>(term);
      return body != nullptr && body->joins() ? body : nullptr;
    };
    std::vector<const Cosserat *> bodies;
    for (const auto *term : terms)
      if (const auto *const body = joining(term))
        bodies.push_back(body);
    if (!joins() || bodies.size() < 2)
      return nullptr;
    terms.erase(std::remove_if(terms.begin(), terms.end(), joining), terms.end());
    return std::make_unique<JoinedBodies<dim>>(bodies);
  }



  template std::unique_ptr<Deformation> Cosserat<1>::joined(std::vector<const Deformation *> &) const;
  template std::unique_ptr<Deformation> Cosserat<2>::joined(std::vector<const Deformation *> &) const;
} // namespace samara
