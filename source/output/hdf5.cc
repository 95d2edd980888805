#include <samara/output/file.h>
#include <samara/output/hdf5.h>

#include <filesystem>
#include <stdexcept>

namespace samara
{
  namespace hdf5
  {
    namespace
    {
      /** Keep what the operating system said, if this entry of the library's call stack tells it. */
      herr_t
      find_system_message(unsigned int, const H5E_error2_t *const error, void *const message)
      {
        const std::string text = error->desc == nullptr ? "" : error->desc, begin = "error message = '";
        const std::size_t at = text.find(begin);
        if (at != std::string::npos)
          *static_cast<std::string *>(message) =
            text.substr(at + begin.size(), text.find('\'', at + begin.size()) - at - begin.size());
        return 0;
      }



      [[noreturn]] void
      fail(const std::string &what)
      {
        std::string reason;
        H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, &find_system_message, &reason);
        throw std::runtime_error(what + (reason.empty() ? "" : ": " + reason));
      }
    } // namespace



    Handle::Handle(const hid_t id, herr_t (*const close_function)(hid_t))
      : id(id)
      , close_function(close_function)
    {
      if (id < 0)
        fail("the HDF5 library refused");
    }



    Handle::~Handle()
    {
      if (id >= 0)
        close_function(id);
    }



    void
    Handle::close()
    {
      if (close_function(std::exchange(id, -1)) < 0)
        fail("the HDF5 library could not close it");
    }



    Quiet::Quiet()
    {
      // On its way out the library would try again to write what it could not, and crash. We close everything
      // ourselves.
      static const herr_t never_at_exit = H5dont_atexit();
      static_cast<void>(never_at_exit);

      H5Eget_auto2(H5E_DEFAULT, &function, &data);
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }



    Quiet::~Quiet()
    {
      H5Eset_auto2(H5E_DEFAULT, function, data);
    }



    void
    write_file(const std::string &file, const std::function<void(hid_t)> &write)
    {
      const Quiet quiet;
      try
        {
          Handle handle(H5Fcreate(part_of(file).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), &H5Fclose);
          write(handle);
          handle.close();
        }
      catch (const std::runtime_error &error)
        {
          std::error_code ignored;
          std::filesystem::remove(part_of(file), ignored);
          throw std::runtime_error("cannot write " + file + ": " + error.what() + ".");
        }
      replace_by_part(file);
    }



    void
    check(const herr_t error)
    {
      if (error < 0)
        fail("the HDF5 library failed");
    }



    std::string
    read_attribute(const hid_t object, const std::string &name)
    {
      const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), &H5Aclose);
      const Handle type(H5Aget_type(attribute), &H5Tclose);
      std::string  text(H5Tget_size(type), '\0');
      check(H5Aread(attribute, type, text.data()));
      text.pop_back(); // the final zero
      return text;
    }
  } // namespace hdf5
} // namespace samara
