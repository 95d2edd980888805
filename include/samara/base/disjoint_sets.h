#ifndef samara_base_disjoint_sets_h
#define samara_base_disjoint_sets_h

#include <numeric>
#include <vector>

namespace samara
{
  /** Numbers 0 … n − 1 in groups that are joined two at a time; each group is known by one of its numbers, its root. */
  class DisjointSets
  {
  public:
    explicit DisjointSets(const unsigned int n)
      : root(n)
    {
      std::iota(root.begin(), root.end(), 0);
    }

    /** Shortens the way to the root for later calls. */
    unsigned int
    root_of(unsigned int i)
    {
      while (root[i] != i)
        i = root[i] = root[root[i]];
      return i;
    }

    /** Join the groups of two numbers; the root is that of @p into. */
    void
    join(const unsigned int i, const unsigned int into)
    {
      root[root_of(i)] = root_of(into);
    }

  private:
    std::vector<unsigned int> root;
  };
} // namespace samara

#endif
