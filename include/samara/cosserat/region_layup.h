#ifndef samara_cosserat_region_layup_h
#define samara_cosserat_region_layup_h

#include <samara/base/value.h>

#include <string>

namespace samara
{
  /** Which layup a region of a shell has, as users write it: "skin, quasi-isotropic". */
  struct RegionLayup
  {
    std::string region, layup;
  };

  template <>
  struct Value<RegionLayup>
  {
    static constexpr char separator = ';';
    static constexpr bool has_unit  = false;

    static RegionLayup    read(const std::string &text, const std::string &unit, const Quantities &quantities);
    static std::string    write(const RegionLayup &value);
    static PatternPointer pattern();
  };
} // namespace samara

#endif
