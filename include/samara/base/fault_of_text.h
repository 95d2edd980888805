#ifndef samara_base_fault_of_text_h
#define samara_base_fault_of_text_h

#include <string>

namespace samara
{
  /** What begins a text, see Quantities::texts, that could not be read: what follows is why, and told where it is used. */
  inline const std::string fault_of_text = "\x01";
} // namespace samara

#endif
