#ifndef samara_tests_orders_h
#define samara_tests_orders_h

// Orders of convergence of the members of the integrator family.

#include "time/measured.h"

namespace samara
{
  /** A member, the steps of its longer run, and the order by which twice as many are better. */
  struct MemberOrder
  {
    unsigned int s;
    double       rho;
    unsigned int n;
    double       order;
  };

  /** Of rotors over half a turn or so. */
  const std::vector<MemberOrder> orders_in_flight = {{1, 1., 30, 2},
                                                     {2, 1., 24, 4},
                                                     {2, 0., 24, 3},
                                                     {3, 1., 16, 6},
                                                     {3, 0., 16, 5}};

  /** Of what @p result(tableau, n) comes to with @p n steps, against @p exact. */
  template <typename Result>
  void
  expect_orders(const std::vector<MemberOrder> &members,
                const std::vector<double>      &exact,
                const double                    bound,
                const Result                   &result)
  {
    for (const MemberOrder &m : members)
      {
        const Tableau tableau(m.s, m.rho);
        const double  coarse = distance(result(tableau, m.n), exact), fine = distance(result(tableau, 2 * m.n), exact);
        EXPECT_NEAR(std::log2(coarse / fine), m.order, bound)
          << "s = " << m.s << ", rho = " << m.rho << ", errors " << coarse << " " << fine;
      }
  }
} // namespace samara

#endif
