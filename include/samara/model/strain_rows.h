#ifndef samara_model_strain_rows_h
#define samara_model_strain_rows_h

#include <Eigen/Dense>

#include <vector>

namespace samara
{
  /** A sparse matrix by rows, written from the first row to the last; several entries of one column are added. */
  struct SparseRows
  {
    std::vector<unsigned int> start = {0}, columns;
    std::vector<double>       values;

    unsigned int
    n_rows() const
    {
      return start.size() - 1;
    }
    void
    begin_row()
    {
      start.push_back(columns.size());
    }
    void
    add_entry(const unsigned int column, const double value)
    {
      columns.push_back(column);
      values.push_back(value);
      start.back() = columns.size();
    }

    /** One element of A x. */
    template <typename Number>
    Number
    row_times(const unsigned int i, const Number *x) const
    {
      Number sum(0);
      for (unsigned int k = start[i]; k < start[i + 1]; ++k)
        sum += values[k] * x[columns[k]];
      return sum;
    }
  };



  /**
   * Strains linearised about one configuration, one row of B each, e = B ζ, and the materials that belong to them:
   * points of one to twelve strains with the stresses σ = C e + C_d ė and the forces Bᵀ w σ, w the weight of the point.
   *
   * For matrices in which stresses are unknowns: B, C and w keep all the digits that BᵀCB loses where stiff and soft
   * strains share their unknowns (doc/theory/modes.md).
   */
  class StrainRows
  {
  public:
    struct Point
    {
      unsigned int first_row, size; ///< its rows of B
      unsigned int first_strain;    ///< the same among the strains and stresses of a state
      double       weight;          ///< [m], [m²] or 1
      unsigned int material;        ///< where C and C_d begin in their arrays, each size × size
    };

    /** @param n_unknowns columns beyond it, those of the ground, are left out */
    explicit StrainRows(const unsigned int n_unknowns)
      : n_unknowns(n_unknowns)
    {}

    /** @name To fill in: a point, then its rows, each with its entries @{ */
    template <typename Matrix>
    void
    add_point(const unsigned int first_strain, const double weight, const Matrix &C, const Matrix &C_d)
    {
      points.push_back({B.n_rows(),
                        static_cast<unsigned int>(C.rows()),
                        first_strain,
                        weight,
                        static_cast<unsigned int>(stiffness.size())});
      stiffness.insert(stiffness.end(), C.data(), C.data() + C.size());
      viscosity.insert(viscosity.end(), C_d.data(), C_d.data() + C_d.size());
    }
    void
    begin_row()
    {
      B.begin_row();
    }
    void
    add_entry(const unsigned int column, const double value)
    {
      if (column < n_unknowns && value != 0.)
        B.add_entry(column, value);
    }
    /** @} */

    using Block = Eigen::Map<const Eigen::MatrixXd>;
    Block
    C(const Point &p) const
    {
      return {&stiffness[p.material], p.size, p.size};
    }
    Block
    C_d(const Point &p) const
    {
      return {&viscosity[p.material], p.size, p.size};
    }
    bool is_viscous() const;

    SparseRows         B;
    std::vector<Point> points;

  private:
    unsigned int        n_unknowns;
    std::vector<double> stiffness, viscosity;
  };
} // namespace samara

#endif
