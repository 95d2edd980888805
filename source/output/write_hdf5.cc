#include <samara/output/write_hdf5.h>

#include <hdf5.h>

#include <set>
#include <stdexcept>

namespace samara
{
  namespace
  {
    /** An object of the HDF5 library, closed when it goes out of scope; an exception if it could not be made. */
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*const close_function)(hid_t))
        : id(id)
        , close_function(close_function)
      {
        if (id < 0)
          throw std::runtime_error("the HDF5 library refused");
      }

      Handle(const Handle &)            = delete;
      Handle &operator=(const Handle &) = delete;

      ~Handle()
      {
        if (id >= 0)
          close_function(id);
      }

      operator hid_t() const
      {
        return id;
      }

      /** Close it now, where a failure can still be told. */
      void
      close()
      {
        const herr_t error = close_function(id);
        id                 = -1;
        if (error < 0)
          throw std::runtime_error("the HDF5 library could not close it");
      }

    private:
      hid_t id;
      herr_t (*close_function)(hid_t);
    };



    /** The library prints its whole call stack on every error; we throw instead. */
    class QuietHdf5
    {
    public:
      QuietHdf5()
      {
        H5Eget_auto2(H5E_DEFAULT, &function, &data);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      }

      ~QuietHdf5()
      {
        H5Eset_auto2(H5E_DEFAULT, function, data);
      }

    private:
      H5E_auto2_t function = nullptr;
      void       *data     = nullptr;
    };



    void
    check(const herr_t error)
    {
      if (error < 0)
        throw std::runtime_error("the HDF5 library could not write");
    }



    void
    write_unit(const hid_t dataset, const std::string &unit)
    {
      const Handle type(H5Tcopy(H5T_C_S1), &H5Tclose);
      check(H5Tset_size(type, unit.size() + 1)); // with the final zero: HDF5 knows no texts of length 0
      check(H5Tset_cset(type, H5T_CSET_UTF8));
      const Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
      const Handle attribute(H5Acreate2(dataset, "unit", type, space, H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
      check(H5Awrite(attribute, type, unit.c_str()));
    }



    void
    write_column(const hid_t file, const std::string &name, const std::string &unit, const std::vector<double> &values)
    {
      const Handle links(H5Pcreate(H5P_LINK_CREATE), &H5Pclose);
      check(H5Pset_create_intermediate_group(links, 1));
      check(H5Pset_char_encoding(links, H5T_CSET_UTF8));

      const hsize_t size = values.size();
      const Handle  space(H5Screate_simple(1, &size, nullptr), &H5Sclose);
      const Handle  dataset(H5Dcreate2(file, name.c_str(), H5T_NATIVE_DOUBLE, space, links, H5P_DEFAULT, H5P_DEFAULT),
                           &H5Dclose);
      if (size > 0)
        check(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
      write_unit(dataset, unit);
    }
  } // namespace



  void
  write_hdf5(const std::string                                      &file,
             const std::vector<std::pair<std::string, std::string>> &columns,
             const std::vector<std::vector<double>>                 &values)
  {
    const QuietHdf5 quiet;
    try
      {
        Handle                handle(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), &H5Fclose);
        std::set<std::string> written;
        for (unsigned int c = 0; c < columns.size(); ++c)
          if (written.insert(columns[c].first).second)
            write_column(handle, columns[c].first, columns[c].second, values[c]);
        handle.close();
      }
    catch (const std::runtime_error &error)
      {
        throw std::runtime_error("cannot write " + file + ": " + error.what() + ".");
      }
  }
} // namespace samara
