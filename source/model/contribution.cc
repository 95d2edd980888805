#include <samara/model/contribution.h>

namespace samara
{
  namespace
  {
    class EvaluatedStrains : public LinearStrains
    {
    public:
      explicit EvaluatedStrains(const Contribution &contribution)
        : contribution(contribution)
      {}

      void
      renew(const Point<double> &p) override
      {
        point        = p;
        point.factor = 0; // no loads
      }

      void
      strains(const double *y, const double *rates, double *e) const override
      {
        Point<double> at = point;
        at.y             = y;
        at.rates         = rates;
        contribution.strain_rates(at, e);
      }

      void
      add_forces(const double *stress, double *r) const override
      {
        Point<double> at = point;
        at.stress        = stress - contribution.first_strain;
        contribution.residual(at, r);
      }

    private:
      const Contribution &contribution;
      Point<double>       point;
    };
  } // namespace



  std::unique_ptr<LinearStrains>
  Contribution::linear_strains() const
  {
    return std::make_unique<EvaluatedStrains>(*this);
  }
} // namespace samara
