#ifndef samara_time_four_nodes_h
#define samara_time_four_nodes_h

#include <samara/base/lanes.h>

#include <algorithm>
#include <array>
#include <vector>

namespace samara
{
  /** Four nodes at once, each in a lane; behind the last node of a model, it fills up. */
  class FourNodes
  {
  public:
    using Lane = Lanes<double>::type;

    FourNodes(const unsigned int first, const unsigned int n_nodes)
    {
      for (unsigned int l = 0; l < 4; ++l)
        {
          nodes[l]     = std::min(first + l, n_nodes - 1);
          is_wanted[l] = first + l < n_nodes;
        }
    }

    unsigned int
    operator[](const unsigned int lane) const
    {
      return nodes[lane];
    }

    /** The @p n values of each; in @p values those of node 0 come first. */
    void
    load(const unsigned int n, const std::vector<double> &values, Lane *lanes) const
    {
      std::array<const double *, 4> from;
      for (unsigned int l = 0; l < 4; ++l)
        from[l] = values.data() + n * nodes[l];
      Lanes<double>::load(n, from, lanes);
    }

    void
    store(const unsigned int n, const Lane *lanes, std::vector<double> &values) const
    {
      write(n, lanes, values, 0);
    }

    /** The six unknowns of each, which the ground does not have. @{ */
    void
    load_unknowns(const std::vector<double> &values, Lane *lanes) const
    {
      std::array<const double *, 4> from;
      for (unsigned int l = 0; l < 4; ++l)
        from[l] = values.data() + 6 * (nodes[l] - 1);
      Lanes<double>::load(6, from, lanes);
    }

    void
    store_unknowns(const Lane *lanes, std::vector<double> &values) const
    {
      write(6, lanes, values, 1);
    }
    /** @} */

    /** Of the lanes that are nodes. */
    double
    sum(const Lane &values) const
    {
      double result = 0;
      for (unsigned int l = 0; l < 4; ++l)
        if (is_wanted[l])
          result += values.values[l];
      return result;
    }

  private:
    static constexpr unsigned int most = 12;

    std::array<unsigned int, 4> nodes;
    std::array<bool, 4>         is_wanted;

    void
    write(const unsigned int n, const Lane *lanes, std::vector<double> &values, const unsigned int first_node) const
    {
      double                  not_wanted[most];
      std::array<double *, 4> to;
      for (unsigned int l = 0; l < 4; ++l)
        to[l] = is_wanted[l] ? values.data() + n * (nodes[l] - first_node) : not_wanted;
      Lanes<double>::store(n, lanes, to);
    }
  };
} // namespace samara

#endif
