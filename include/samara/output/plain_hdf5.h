#ifndef samara_output_plain_hdf5_h
#define samara_output_plain_hdf5_h

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace samara
{
  /**
   * The bytes of a HDF5 file of 1-D datasets, each with one text attribute and in one piece. Such files need so little
   * of the format that they are written without the HDF5 library, which takes milliseconds to start and to lay out what
   * is known beforehand; a short analysis does not take longer. They are read by it as any other (HDF5 1.8 or later).
   *
   * A file begins with head(); the numbers of each dataset stand at place(). Equal datasets give equal bytes, for there
   * are no times in them. Written is
   *
   *     superblock   version 2; lengths and places have 8 bytes
   *     groups       object headers of version 2, with a link message for each member, names in UTF-8
   *     datasets     object headers of version 2: sizes, type, contiguous layout, the attribute if it has a name
   *
   * of the "HDF5 File Format Specification", version 2 or 3. Needs a processor with the little end first.
   */
  class PlainHdf5
  {
  public:
    /** What a dataset is made of: IEEE numbers of 64 bits, or integers of 8. */
    enum class Kind
    {
      real,
      character
    };

    /**
     * A dataset more. Groups in its path, between "/", are made. Throws a std::runtime_error if there is one of this
     * path, if the path is that of a group, or if a text is longer than what a header holds, 64 kB.
     * @return its number, from 0
     */
    unsigned int add(const std::string &path,
                     Kind               kind,
                     std::uint64_t      size,
                     const std::string &attribute = "",
                     const std::string &text      = "");

    /** Everything in front of the numbers. Nothing can be added behind this. */
    std::string head();

    /** Where the numbers of a dataset begin, from the beginning of the file; known after head(). */
    std::uint64_t
    place(const unsigned int dataset) const
    {
      return datasets[dataset].place;
    }

    /** The whole file, given the bytes of each dataset. */
    std::string image(const std::vector<std::string> &contents);

  private:
    struct Dataset
    {
      Kind          kind;
      std::uint64_t size; ///< numbers
      std::string   attribute, text;
      std::uint64_t header, place; ///< in the file

      std::uint64_t n_bytes() const;
    };

    struct Group
    {
      std::map<std::string, unsigned int> groups, datasets; ///< members by name
      std::uint64_t                       header = 0;
    };

    std::vector<Dataset> datasets;
    std::vector<Group>   groups = {Group()}; ///< the root, and the others behind those they are in

    std::string superblock(std::uint64_t size) const;
    std::string header_of(const Group &group) const;
    std::string header_of(const Dataset &dataset) const;
  };
} // namespace samara

#endif
