#ifndef samara_output_hdf5_h
#define samara_output_hdf5_h

#include <hdf5.h>

#include <functional>
#include <string>
#include <utility>

namespace samara
{
  /**
   * What all users of the HDF5 library need. Failures are a std::runtime_error without the name of the file, which the
   * library does not know at that place: catch it and say which file it was.
   */
  namespace hdf5
  {
    /** An object of the library, closed when it goes out of scope; an exception if it could not be made. */
    class Handle
    {
    public:
      Handle(hid_t id, herr_t (*close_function)(hid_t));

      Handle(Handle &&other)
        : id(std::exchange(other.id, -1))
        , close_function(other.close_function)
      {}

      ~Handle();

      operator hid_t() const
      {
        return id;
      }

      /** Close it now, where a failure can still be told. */
      void close();

    private:
      hid_t id;
      herr_t (*close_function)(hid_t);
    };



    /**
     * While it lives, the library does not print its call stack on every error. Make one before any other call of the
     * library.
     */
    class Quiet
    {
    public:
      Quiet();
      Quiet(const Quiet &)            = delete;
      Quiet &operator=(const Quiet &) = delete;
      ~Quiet();

    private:
      H5E_auto2_t function = nullptr;
      void       *data     = nullptr;
    };



    /**
     * Write a file beside @p file by @p write, which is given it, and let it take the place of @p file; if that fails the
     * old content stays. @throws std::runtime_error with the name of the file
     */
    void write_file(const std::string &file, const std::function<void(hid_t)> &write);

    /** Throw if the library returned a failure. */
    void check(herr_t error);

    /** A text attribute. */
    std::string read_attribute(hid_t object, const std::string &name);
  } // namespace hdf5
} // namespace samara

#endif
