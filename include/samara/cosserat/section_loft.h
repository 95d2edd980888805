#ifndef samara_cosserat_section_loft_h
#define samara_cosserat_section_loft_h

#include <samara/cosserat/analysed_shape.h>

#include <array>
#include <map>

namespace samara
{
  /** Sections between two of one kind, whose shape changes along straight lines from the one to the other. */
  class SectionLoft
  {
  public:
    virtual ~SectionLoft() = default;

    /** At the share @p w of the way, from 0 to 1. @throws std::invalid_argument as Section::at() does */
    virtual SectionValues at(double w, const Vector3 &curvature) const = 0;

    /** The shape there, of which stresses can be found; null if there is only a closed form. */
    virtual std::shared_ptr<const AnalysedShape>
    shape(double /*w*/) const
    {
      return nullptr;
    }
  };



  /** Of sections in closed form. */
  class ClosedFormLoft : public SectionLoft
  {
  public:
    explicit ClosedFormLoft(const std::function<SectionValues(double)> &values)
      : values(values)
    {}

    SectionValues
    at(const double w, const Vector3 &) const override
    {
      return values(w);
    }

  private:
    std::function<SectionValues(double)> values;
  };



  /**
   * Of sections that are analysed. For each curvature values are the polynomial in w through Chebyshev's points
   * (1 − cos πj/n)/2: of n = 1, 2, 4, 8, 16 the one after the first that meets the values at the next points to 1e-6
   * of √(c_ii c_jj). Areas and moments are polynomials of degree 2 and 4 of w, so few analyses do. Where the curvature
   * varies along the beam, each place has its own, and there an analysis of its own.
   */
  class AnalysedLoft : public SectionLoft
  {
  public:
    /** Null if the two are not of one kind: shape_between(), degree, trapeze effect or what curvature does differ. */
    static std::unique_ptr<const SectionLoft> make(const std::shared_ptr<const AnalysedShape> &a,
                                                   const std::shared_ptr<const AnalysedShape> &b);

    SectionValues                        at(double w, const Vector3 &curvature) const override;
    std::shared_ptr<const AnalysedShape> shape(double w) const override;

  private:
    struct Polynomial
    {
      std::vector<double>        w; ///< ascending
      std::vector<SectionValues> values;

      SectionValues at(double w) const;
    };

    AnalysedLoft(const std::shared_ptr<const AnalysedShape> &a, const std::shared_ptr<const AnalysedShape> &b)
      : a(a)
      , b(b)
    {}

    std::shared_ptr<const AnalysedShape>                a, b;
    mutable std::map<std::array<double, 3>, Polynomial> of_curvature;

    Polynomial find(const Vector3 &curvature) const;
  };
} // namespace samara

#endif
