#ifndef samara_cosserat_beam_mesh_h
#define samara_cosserat_beam_mesh_h

#include <samara/base/value.h>

#include <string>
#include <vector>

namespace samara
{
  /** Of the polynomials of an element. */
  constexpr unsigned int highest_beam_degree = 6;

  /** More would not fit into the memory, and is a mistyped number. */
  constexpr unsigned int most_elements_of_beam = 1'000'000;



  /** What a user says of the elements of a beam: how many, "4", or how accurate, "automatic, 1e-4". */
  struct ElementsWish
  {
    unsigned int number = 4;
    double       error  = 0; ///< relative, of the strains in the energy norm; 0: not automatic
  };

  template <>
  struct Value<ElementsWish>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = false;

    static ElementsWish   read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const ElementsWish &value);
    static PatternPointer pattern();
  };



  /** An element of a beam: where it ends, from 0 (start of the beam) to 1, and its degree. */
  struct MeshElement
  {
    double       end;
    unsigned int degree;
  };

  /** Written "3 to 0.25", each. @throws std::invalid_argument if the ends do not grow to 1, or degrees are not from 1
   * to highest_beam_degree */
  std::vector<MeshElement> read_mesh(const std::vector<std::string> &texts);
  std::string              mesh_to_text(const std::vector<MeshElement> &mesh);

} // namespace samara

#endif
