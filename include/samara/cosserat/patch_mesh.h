#ifndef samara_cosserat_patch_mesh_h
#define samara_cosserat_patch_mesh_h

#include <samara/base/value.h>

#include <string>
#include <vector>

namespace samara
{
  /** Numbers of elements along the two coordinates of a patch, written "4, 8". */
  struct PatchElements
  {
    unsigned int u = 4, v = 4;
  };

  /** How a coordinate from 0 to 1 is divided. */
  class Division
  {
  public:
    explicit Division(unsigned int n = 1);
    /** @throws std::invalid_argument unless the ends of the pieces grow to 1 */
    explicit Division(const std::vector<double> &ends);

    unsigned int
    n() const
    {
      return ends.size();
    }
    double
    start(const unsigned int i) const
    {
      return i == 0 ? 0. : ends[i - 1];
    }
    double
    length(const unsigned int i) const
    {
      return ends[i] - start(i);
    }
    /** What is @p xi from 0 to 1 in piece @p i. */
    double
    at(const unsigned int i, const double xi) const
    {
      return xi == 1 ? ends[i] : start(i) + xi * length(i);
    }
    /** The piece of a place; of the two at an end the second, also within @p rounding of a piece before it. */
    unsigned int piece(double x, double rounding = 0) const;

    /** Those pieces halved. */
    Division halved(const std::vector<bool> &pieces) const;
    /** With an end more, unless there is one. */
    void add(double end);

    const std::vector<double> &
    all() const
    {
      return ends;
    }

  private:
    std::vector<double> ends;
  };

  /** How a patch is divided along u and v, written "0.25 0.5 1 by 0.5 1": where elements end. */
  struct PatchMesh
  {
    Division u, v;
  };

  /** What a user says of the elements of patches: how many, "4, 8; 2, 8", or how accurate, "automatic, 1e-2", perhaps
   * with numbers to begin with, "automatic, 1e-2 from 4, 8; 2, 8". */
  struct ShellElements
  {
    std::vector<PatchElements> counts = {PatchElements()};
    double                     error  = 0; ///< relative, of the strains in the energy norm; 0: not automatic
  };



  template <>
  struct Value<PatchMesh>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = false;

    static PatchMesh      read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const PatchMesh &value);
    static PatternPointer pattern();
  };

  template <>
  struct Value<ShellElements>
  {
    static constexpr char separator = '\n';
    static constexpr bool has_unit  = false;

    static ShellElements  read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const ShellElements &value);
    static PatternPointer pattern();
  };
} // namespace samara

#endif
