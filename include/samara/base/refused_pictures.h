#ifndef samara_base_refused_pictures_h
#define samara_base_refused_pictures_h

#include <string>

namespace samara
{
  /**
   * Folder for pictures of what is refused while a model is read: that of its results, which whoever reads the model
   * sets; empty: the current folder. It need not exist.
   */
  inline std::string &
  folder_of_refused_pictures()
  {
    static std::string folder;
    return folder;
  }
} // namespace samara

#endif
