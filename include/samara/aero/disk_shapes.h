#ifndef samara_aero_disk_shapes_h
#define samara_aero_disk_shapes_h

#include <array>
#include <vector>

namespace samara
{
  /**
   * Functions on a disk, φ(r) cos mψ and φ(r) sin mψ with φ = r^m Σ_j c_j r^{2j}: polynomials in the Cartesian
   * coordinates (x, y) = r (cos ψ, sin ψ), which are smooth at the centre and go on beyond the edge, r = 1.
   */
  class DiskShapes
  {
  public:
    struct Shape
    {
      unsigned int        m;
      bool                is_sine;
      std::vector<double> c;
    };

    std::vector<Shape> shapes;

    static constexpr unsigned int most_harmonics = 32; ///< m is at most that

    /** All values at (x, y). */
    template <typename Number>
    void
    evaluate(const Number &x, const Number &y, Number *values) const
    {
      Powers<Number> re, im;
      powers(x, y, re, im);
      const Number square = x * x + y * y;
      for (unsigned int k = 0; k < shapes.size(); ++k)
        values[k] = radial(shapes[k], square) * (shapes[k].is_sine ? im : re)[shapes[k].m];
    }

    /** Derivatives of all by x and y. */
    void
    gradients(const double x, const double y, double *by_x, double *by_y) const
    {
      Powers<double> re, im;
      powers(x, y, re, im);
      const double square = x * x + y * y;
      for (unsigned int k = 0; k < shapes.size(); ++k)
        {
          const Shape &s     = shapes[k];
          double       slope = 0; // of the sum over r^{2j}, by r²
          for (unsigned int j = s.c.size(); j-- > 1;)
            slope = slope * square + j * s.c[j];
          const double value = radial(s, square), h = (s.is_sine ? im : re)[s.m];
          // (x + iy)^m has the derivative m (x + iy)^{m−1} by x, and i times it by y
          const double c = s.m > 0 ? s.m * re[s.m - 1] : 0., d = s.m > 0 ? s.m * im[s.m - 1] : 0.;
          by_x[k] = 2 * x * slope * h + value * (s.is_sine ? d : c);
          by_y[k] = 2 * y * slope * h + value * (s.is_sine ? c : -d);
        }
    }

  private:
    template <typename Number>
    using Powers = std::array<Number, most_harmonics + 1>;

    /** Of x + iy, from 0 to the highest m. */
    template <typename Number>
    void
    powers(const Number &x, const Number &y, Powers<Number> &re, Powers<Number> &im) const
    {
      unsigned int highest = 0;
      for (const auto &s : shapes)
        highest = s.m > highest ? s.m : highest;
      re[0] = Number(1);
      im[0] = Number(0);
      for (unsigned int m = 1; m <= highest; ++m)
        {
          re[m] = re[m - 1] * x - im[m - 1] * y;
          im[m] = re[m - 1] * y + im[m - 1] * x;
        }
    }

    template <typename Number>
    static Number
    radial(const Shape &s, const Number &square)
    {
      Number sum(0);
      for (unsigned int j = s.c.size(); j-- > 0;)
        sum = sum * square + s.c[j];
      return sum;
    }
  };
} // namespace samara

#endif
