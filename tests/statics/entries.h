#ifndef samara_tests_statics_entries_h
#define samara_tests_statics_entries_h

// Values of entries that several models take.

#include <samara/base/text.h>

#include "../scene.h"

namespace samara
{
  /** Overrides for the polynomial degree and the number of elements of a beam. */
  inline std::vector<std::string>
  mesh(const std::string &body, const unsigned int degree, const unsigned int elements)
  {
    return {"Bodies/" + body + "/Degree = " + std::to_string(degree),
            "Bodies/" + body + "/Elements = " + std::to_string(elements)};
  }



  /** "x, y, z", all digits. */
  inline std::string
  text_of(const Vector3 &v)
  {
    return number_to_text(v(0)) + ", " + number_to_text(v(1)) + ", " + number_to_text(v(2));
  }
} // namespace samara

#endif
