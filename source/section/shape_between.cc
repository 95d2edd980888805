#include <samara/section/shape_between.h>

#include <algorithm>
#include <cmath>

namespace samara
{
  namespace
  {
    using Place = dealii::Point<2>;

    /** Ends of the same cells in the parameters of either shape. */
    struct SameCells
    {
      std::vector<double> a, b;
    };



    bool
    are_equal(const Ply &x, const Ply &y)
    {
      return x.material == y.material && x.angle == y.angle;
    }



    bool
    are_equal(const SectionMaterial &x, const SectionMaterial &y)
    {
      return x.name == y.name && x.stiffness == y.stiffness && x.density == y.density;
    }



    /** @p ends on the interval that @p others cover. */
    std::vector<double>
    moved(const std::vector<double> &ends, const std::vector<double> &others)
    {
      const double        scale = (others.back() - others.front()) / (ends.back() - ends.front());
      std::vector<double> result;
      for (const double x : ends)
        result.push_back(others.front() + scale * (x - ends.front()));
      result.back() = others.back();
      return result;
    }



    /** As many cells as the one has that has more; nothing if there must not be others than there are. */
    std::optional<SameCells>
    same_cells(const std::vector<double> &a, const std::vector<double> &b, const bool may_be_divided)
    {
      if (a.size() == b.size())
        return SameCells{a, b};
      if (!may_be_divided)
        return {};
      return a.size() > b.size() ? SameCells{a, moved(a, b)} : SameCells{moved(b, a), b};
    }



    /** Whether a patch has one ply all along u, or along v. */
    bool
    is_uniform(const SectionPatch &patch, const bool along_u)
    {
      for (unsigned int i = 0; i + 1 < patch.u.size(); ++i)
        for (unsigned int j = 0; j + 1 < patch.v.size(); ++j)
          if (!are_equal(patch.ply(i, j), along_u ? patch.ply(0, j) : patch.ply(i, 0)))
            return false;
      return true;
    }



    /** The parameter in one shape of what is at @p x in the other: linear in each cell. */
    double
    in_other(const std::vector<double> &from, const std::vector<double> &to, const double x)
    {
      const unsigned int n     = from.size() - 1;
      const unsigned int above = std::upper_bound(from.begin() + 1, from.end() - 1, x) - from.begin();
      const unsigned int i     = std::min(above, n) - 1;
      return to[i] + (to[i + 1] - to[i]) * ((x - from[i]) / (from[i + 1] - from[i]));
    }



    std::optional<SectionPatch>
    patch_between(const SectionPatch &a, const SectionPatch &b, const double w)
    {
      if (a.name != b.name || a.group != b.group || a.tangent || b.tangent)
        return {};
      const auto u = same_cells(a.u, b.u, is_uniform(a, true) && is_uniform(b, true)),
                 v = same_cells(a.v, b.v, is_uniform(a, false) && is_uniform(b, false));
      if (!u || !v)
        return {};
      // the cell of a patch that is divided otherwise: the first one of its row, all of which are of one ply
      const auto ply_in = [&](const SectionPatch &patch, const unsigned int i, const unsigned int j) {
        return patch.ply(patch.u.size() == u->a.size() ? i : 0, patch.v.size() == v->a.size() ? j : 0);
      };
      for (unsigned int i = 0; i + 1 < u->a.size(); ++i)
        for (unsigned int j = 0; j + 1 < v->a.size(); ++j)
          if (!are_equal(ply_in(a, i, j), ply_in(b, i, j)))
            return {};

      SectionPatch result;
      result.name  = a.name;
      result.group = a.group;
      result.u     = u->a;
      result.v     = v->a;
      result.place = [of_a = a.place, of_b = b.place, u = *u, v = *v, w](const double s, const double t) {
        return Place((1 - w) * of_a(s, t) + w * of_b(in_other(u.a, u.b, s), in_other(v.a, v.b, t)));
      };
      result.ply = [ply = a.ply, along_u = a.u.size() == u->a.size(), along_v = a.v.size() == v->a.size()](
                     const unsigned int i, const unsigned int j) { return ply(along_u ? i : 0, along_v ? j : 0); };
      return result;
    }
  } // namespace



  std::optional<SectionShape>
  shape_between(const SectionShape &a, const SectionShape &b, const double w)
  {
    const auto same = [](const SectionMaterial &x, const SectionMaterial &y) { return are_equal(x, y); };
    if (a.patches.size() != b.patches.size() ||
        !std::equal(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(), same))
      return {};
    SectionShape result;
    result.materials = a.materials;
    result.finest    = (1 - w) * a.finest + w * b.finest;
    for (unsigned int k = 0; k < a.patches.size(); ++k)
      {
        auto patch = patch_between(a.patches[k], b.patches[k], w);
        if (!patch)
          return {};
        result.patches.push_back(std::move(*patch));
      }
    result.outline = a.outline;
    if (a.outline.size() == b.outline.size())
      for (unsigned int i = 0; i < a.outline.size(); ++i)
        result.outline[i] = (1 - w) * a.outline[i] + w * b.outline[i];
    return result;
  }
} // namespace samara
