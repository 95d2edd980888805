#include <samara/model/terms.h>

namespace samara
{
  namespace
  {
    class EvaluatedStrains : public LinearStrains
    {
    public:
      explicit EvaluatedStrains(const Deformation &deformation)
        : deformation(deformation)
      {}

      void
      renew(const Point<double> &p) override
      {
        point = p;
      }

      void
      strains(const double *y, const double *rates, double *e) const override
      {
        Point<double> at = point;
        at.y             = y;
        at.rates         = rates;
        deformation.strain_rates(at, e);
      }

      void
      add_forces(const double *stress, double *r) const override
      {
        Point<double> at = point;
        at.stress        = stress - deformation.first_strain;
        deformation.residual(at, r);
      }

    private:
      const Deformation &deformation;
      Point<double>      point;
    };
  } // namespace



  std::unique_ptr<LinearStrains>
  Deformation::linear_strains() const
  {
    return std::make_unique<EvaluatedStrains>(*this);
  }
} // namespace samara
