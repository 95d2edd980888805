#include <samara/base/errors.h>
#include <samara/output/checkpoint.h>
#include <samara/output/file.h>
#include <samara/output/hdf5.h>
#include <samara/output/plain_hdf5.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace samara
{
  namespace
  {
    using hdf5::check, hdf5::Handle;

    constexpr std::size_t head_size = 512; // one of the places where HDF5 looks for its beginning
    const std::string     title     = "samara checkpoint, format ";
    const std::string     format    = "6";

    const std::pair<const char *, std::vector<double> State::*> vectors_of_state[] = {
      {"state/q", &State::q},
      {"state/coordinates", &State::coordinates},
      {"state/y", &State::y},
      {"state/rates", &State::rates},
      {"state/states", &State::states},
      {"state/state rates", &State::state_rates},
      {"state/multipliers", &State::multipliers},
      {"state/stress", &State::stress},
      {"state/accelerations", &State::accelerations}};

    // -------------------------------------------------------------------------------------------------------- head

    /** FNV-1a of 64 bits. */
    std::uint64_t
    checksum(const std::string &bytes)
    {
      std::uint64_t sum = 0xcbf29ce484222325u;
      for (const char c : bytes)
        sum = (sum ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
      return sum;
    }



    /** What stands before these bytes of HDF5. A file is intact if its head is that of its body. */
    std::string
    head_of(const std::string &body)
    {
      std::string head = title + format + "\n" + std::to_string(body.size()) + " bytes of HDF5 from byte " +
                         std::to_string(head_size) + " on, checksum " + std::to_string(checksum(body)) + "\n";
      head.resize(head_size, '\n');
      return head;
    }



    /** The bytes of HDF5 in this file, intact; or an InputError. */
    std::string
    read_body(const std::string &file)
    {
      if (!std::filesystem::exists(file))
        throw InputError("there is no checkpoint " + file + "; start without --restart.");
      std::error_code error;
      const auto      size = std::filesystem::file_size(file, error);
      std::string     content(error ? 0 : size, '\0');
      std::ifstream   in(file, std::ios::binary);
      if (error || !in.read(content.data(), content.size()))
        throw InputError("the checkpoint " + file + " cannot be read" + (error ? ": " + error.message() : "") + ".");

      if (content.compare(0, title.size(), title, 0, content.size()) != 0)
        throw InputError(file + " is not a checkpoint that samara wrote.");
      if (content.size() >= head_size && content.compare(title.size(), format.size() + 1, format + "\n") != 0)
        throw InputError("the checkpoint " + file +
                         " was written by another version of samara; start without --restart.");
      std::string body = content.size() > head_size ? content.substr(head_size) : "";
      if (content.compare(0, head_size, head_of(body)) != 0)
        throw InputError("the checkpoint " + file +
                         " is damaged: a part of it is missing or changed; start without --restart.");
      return body;
    }

    // ----------------------------------------------------------------------------------------------- HDF5, written

    /** A file in memory that is being written. */
    class Body
    {
    public:
      template <typename Numbers>
      void
      write(const std::string &path,
            const Numbers     &values,
            const std::string &attribute = "",
            const std::string &text      = "")
      {
        using Number = typename Numbers::value_type;
        file.add(path,
                 sizeof(Number) == 1 ? PlainHdf5::Kind::character : PlainHdf5::Kind::real,
                 values.size(),
                 attribute,
                 text);
        contents.emplace_back(reinterpret_cast<const char *>(values.data()), sizeof(Number) * values.size());
      }

      /** Arrays under names that may contain anything: they are numbered, and the name is an attribute. */
      void
      write_named(const std::string &group, const std::map<std::string, std::vector<double>> &arrays)
      {
        unsigned int index = 0;
        for (const auto &[name, values] : arrays)
          write(group + "/" + std::to_string(index++), values, "name", name);
      }

      std::string
      image()
      {
        return file.image(contents);
      }

    private:
      PlainHdf5                file;
      std::vector<std::string> contents;
    };

    // -------------------------------------------------------------------------------------------------- HDF5, read

    /** Properties of a file in memory that never comes to the disk by itself. */
    Handle
    in_memory()
    {
      Handle access(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose);
      check(H5Pset_fapl_core(access, 1 << 20, 0));
      return access;
    }



    hid_t
    type_of(const double)
    {
      return H5T_NATIVE_DOUBLE;
    }

    hid_t
    type_of(const char)
    {
      return H5T_NATIVE_CHAR;
    }



    template <typename Number>
    std::vector<Number>
    read(const hid_t file, const std::string &path)
    {
      const Handle        dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), &H5Dclose);
      const Handle        space(H5Dget_space(dataset), &H5Sclose);
      std::vector<Number> values(H5Sget_simple_extent_npoints(space));
      if (!values.empty())
        check(H5Dread(dataset, type_of(Number()), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
      return values;
    }



    double
    read_number(const hid_t file, const std::string &path)
    {
      const std::vector<double> numbers = read<double>(file, path);
      if (numbers.size() != 1)
        throw std::runtime_error(path + " is not one number");
      return numbers[0];
    }



    std::map<std::string, std::vector<double>>
    read_named(const hid_t file, const std::string &group)
    {
      std::map<std::string, std::vector<double>> arrays;
      for (unsigned int index = 0;; ++index)
        {
          const std::string path = group + "/" + std::to_string(index);
          if (H5Lexists(file, path.c_str(), H5P_DEFAULT) <= 0)
            return arrays;
          const Handle dataset(H5Dopen2(file, path.c_str(), H5P_DEFAULT), &H5Dclose);
          arrays[hdf5::read_attribute(dataset, "name")] = read<double>(file, path);
        }
    }

    // ------------------------------------------------------------------------------------------------------- state

    std::vector<double>
    numbers_of(const std::vector<State::Motion> &motion)
    {
      std::vector<double> numbers;
      for (const State::Motion &m : motion)
        for (const Vector3 &vector : {m.spin, m.velocity, m.at})
          numbers.insert(numbers.end(), vector.data(), vector.data() + 3);
      return numbers;
    }



    std::vector<State::Motion>
    motion_of(const std::vector<double> &numbers)
    {
      std::vector<State::Motion> motion(numbers.size() / 9);
      const double              *at = numbers.data();
      for (State::Motion &m : motion)
        for (Vector3 *vector : {&m.spin, &m.velocity, &m.at})
          {
            *vector = Eigen::Map<const Vector3>(at);
            at += 3;
          }
      return motion;
    }



    void
    write_state(Body &body, const State &state)
    {
      for (const auto &[path, vector] : vectors_of_state)
        body.write(path, state.*vector);
      body.write("state/motion", numbers_of(state.motion));
      body.write("state/time", std::vector<double>{state.time});
      body.write("state/factor", std::vector<double>{state.factor});
      body.write("state/held", std::vector<double>{state.held ? 1. : 0.});
      body.write("state/left out", std::vector<double>(state.left_out.begin(), state.left_out.end()));
      std::vector<double> bristles;
      for (const PairBristle &b : state.bristles)
        {
          const Vector3 &z = b.deflection;
          for (const double number :
               {double(b.group), double(b.bead), double(b.other), double(b.kind), b.at_b, b.at_a, z(0), z(1), z(2)})
            bristles.push_back(number);
        }
      body.write("state/bristles", bristles);
    }



    State
    read_state(const hid_t file)
    {
      State state;
      for (const auto &[path, vector] : vectors_of_state)
        state.*vector = read<double>(file, path);
      state.motion                       = motion_of(read<double>(file, "state/motion"));
      state.time                         = read_number(file, "state/time");
      state.factor                       = read_number(file, "state/factor");
      state.held                         = read_number(file, "state/held") != 0;
      const std::vector<double> left_out = read<double>(file, "state/left out");
      state.left_out.assign(left_out.begin(), left_out.end());
      const std::vector<double> bristles = read<double>(file, "state/bristles");
      for (std::size_t i = 0; i + 9 <= bristles.size(); i += 9)
        {
          const double *const b      = &bristles[i];
          const auto          number = [&](const unsigned int j) { return static_cast<unsigned int>(b[j]); };
          state.bristles.push_back({number(0), number(1), number(2), number(3), b[4], b[5], {b[6], b[7], b[8]}});
        }
      return state;
    }

    // -------------------------------------------------------------------------------------------------- checkpoint

    std::string
    body_of(const Checkpoint &checkpoint)
    {
      Body body;
      write_state(body, checkpoint.state);
      body.write("step", std::vector<double>{checkpoint.step});
      body.write("model", *checkpoint.model);
      body.write_named("arrays", checkpoint.arrays);
      std::map<std::string, std::vector<double>> numbers;
      for (const auto &[name, number] : checkpoint.numbers)
        numbers[name] = {number};
      body.write_named("numbers", numbers);
      return body.image();
    }



    Checkpoint
    checkpoint_of(std::string &body)
    {
      const Handle access = in_memory();
      check(H5Pset_file_image(access, body.data(), body.size()));
      const Handle file(H5Fopen("checkpoint", H5F_ACC_RDONLY, access), &H5Fclose);

      Checkpoint checkpoint;
      checkpoint.state              = read_state(file);
      checkpoint.step               = read_number(file, "step");
      const std::vector<char> model = read<char>(file, "model");
      checkpoint.model              = std::make_shared<const std::string>(model.begin(), model.end());
      checkpoint.arrays             = read_named(file, "arrays");
      for (const auto &[name, numbers] : read_named(file, "numbers"))
        checkpoint.numbers[name] = numbers.at(0);
      return checkpoint;
    }
  } // namespace



  void
  write_checkpoint(const std::string &file, const Checkpoint &checkpoint, const bool wait)
  {
    std::string body;
    try
      {
        body = body_of(checkpoint);
      }
    catch (const std::runtime_error &error)
      {
        throw std::runtime_error("cannot write " + file + ": " + error.what() + ".");
      }
    replace_file(file, head_of(body) + body, wait);
  }



  Checkpoint
  read_checkpoint(const std::string &file)
  {
    std::string       body = read_body(file);
    const hdf5::Quiet quiet;
    try
      {
        return checkpoint_of(body);
      }
    catch (const std::runtime_error &error)
      {
        throw InputError("the checkpoint " + file + " cannot be read: " + error.what() + "; start without --restart.");
      }
  }
} // namespace samara
