#ifndef samara_model_field_h
#define samara_model_field_h

#include <deal.II/base/exceptions.h>

#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace samara
{
  /**
   * A quantity by name at the samples of a drawing, or on its cells: what pictures are coloured by. Values are kept
   * with 32 bits, as they are written; where none was set they are not a number.
   */
  class Field
  {
  public:
    const std::string name, unit; ///< "section force", "N"

    /**
     * What its numbers are called, one by one; none: it is a single number. Axes say in which frame: inertial_axes,
     * section_axes, others in their own words ("11", "22", "12").
     */
    const std::vector<std::string> components;

    const bool is_on_cells;

    Field(const std::string              &name,
          const std::string              &unit,
          const std::vector<std::string> &components,
          const bool                      is_on_cells)
      : name(name)
      , unit(unit)
      , components(components)
      , is_on_cells(is_on_cells)
    {}

    unsigned int
    n_components() const
    {
      return components.empty() ? 1 : components.size();
    }

    /** The number, or the components, at sample, or on cell, @p i. */
    template <typename Values>
    void
    set(const unsigned int i, const Values &values)
    {
      if constexpr (std::is_arithmetic_v<Values>)
        {
          AssertDimension(1, n_components());
          *at(i) = static_cast<float>(values);
        }
      else
        {
          AssertDimension(static_cast<unsigned int>(values.size()), n_components());
          float *const to = at(i);
          for (unsigned int d = 0; d < n_components(); ++d)
            to[d] = static_cast<float>(values[d]);
        }
    }

    float
    operator()(const unsigned int i, const unsigned int component = 0) const
    {
      const std::size_t place = std::size_t(i) * n_components() + component;
      return place < values.size() ? values[place] : std::numeric_limits<float>::quiet_NaN();
    }

    /** One more than the last sample, or cell, with values. */
    unsigned int
    end() const
    {
      return values.size() / n_components();
    }

  private:
    std::vector<float> values;

    float *
    at(const unsigned int i)
    {
      const std::size_t begin = std::size_t(i) * n_components();
      if (values.size() < begin + n_components())
        values.resize(begin + n_components(), std::numeric_limits<float>::quiet_NaN());
      return &values[begin];
    }
  };



  /** Components of vectors, in the inertial frame or in the axes of a section or surface. @{ */
  inline const std::vector<std::string> inertial_axes = {"x", "y", "z"}, section_axes = {"1", "2", "3"};
  /** @} */
} // namespace samara

#endif
