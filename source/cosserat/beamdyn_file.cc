#include <samara/base/number_in_file.h>
#include <samara/base/text.h>
#include <samara/cosserat/beamdyn_file.h>
#include <samara/section/symmetric_matrix.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace samara
{
  namespace
  {
    /** Where the axes 1 2 3 and their moments are in the order of BeamDyn: x y z and theirs. */
    constexpr std::array<int, 6> in_beamdyn = {{2, 0, 1, 5, 3, 4}};

    Matrix6
    from_beamdyn(const Matrix6 &A)
    {
      Matrix6 result;
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          result(i, j) = A(in_beamdyn[i], in_beamdyn[j]);
      return result;
    }



    Matrix6
    to_beamdyn(const Matrix6 &A)
    {
      Matrix6 result;
      for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
          result(in_beamdyn[i], in_beamdyn[j]) = A(i, j);
      return result;
    }



    /** How far a mass matrix is from the one that a plane section has, in the axes 1 2 3. */
    double
    distance_to_a_section(const Matrix6 &I)
    {
      const double  m = I.topLeftCorner<3, 3>().trace() / 3;
      const Vector3 c(0, (I(3, 2) - I(0, 5)) / 2, (I(0, 4) - I(3, 1)) / 2);
      Matrix6       wanted             = Matrix6::Zero();
      wanted.topLeftCorner<3, 3>()     = m * Matrix3::Identity();
      wanted.topRightCorner<3, 3>()    = -skew(c);
      wanted.bottomLeftCorner<3, 3>()  = skew(c);
      wanted.bottomRightCorner<2, 2>() = I.bottomRightCorner<2, 2>();
      wanted(3, 3)                     = I(4, 4) + I(5, 5);
      const double  J                  = std::max(I(3, 3), wanted(3, 3));
      const Matrix6 difference         = (I - wanted).cwiseAbs();
      // masses, first and second moments have different units
      return std::max({difference.topLeftCorner<3, 3>().maxCoeff() / m,
                       difference.topRightCorner<3, 3>().maxCoeff() / std::sqrt(m * J),
                       difference.bottomRightCorner<3, 3>().maxCoeff() / J});
    }



    /** A file of Fortran, line by line. */
    class BeamDynReader
    {
    public:
      explicit BeamDynReader(const std::string &file)
        : file(file)
      {
        std::ifstream in(file);
        if (!in)
          throw std::invalid_argument("cannot read the file " + file);
        for (std::string line; std::getline(in, line);)
          lines.push_back(line);
      }

      [[noreturn]] void
      wrong(const std::size_t i, const std::string &what) const
      {
        throw std::invalid_argument(file + ":" + std::to_string(i + 1) + ": " + what);
      }

      /** The line at or behind @p from that has this word, whatever its letters' case. */
      std::size_t
      find(const std::string &word, const std::size_t from = 0) const
      {
        for (std::size_t i = from; i < lines.size(); ++i)
          if (lower(lines[i]).find(word) != std::string::npos)
            return i;
        throw std::invalid_argument(file + ": there is no line with <" + word + ">, as a blade file of BeamDyn has it");
      }

      /** The first @p n numbers of a line, what stands behind them is words. */
      std::vector<double>
      numbers(const std::size_t i, const std::size_t n) const
      {
        if (i >= lines.size())
          throw std::invalid_argument(file + ": the file ends too early");
        std::string line = lower(lines[i]);
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream  words(line);
        std::vector<double> result;
        for (std::string word; words >> word;)
          {
            std::replace(word.begin(), word.end(), 'd', 'e'); // 1.0D+3
            double x = 0;
            if (!fault_of_number(word, x).empty())
              break;
            result.push_back(x);
          }
        // as many numbers: what stands behind them may be words, but one number more is a row that is not understood
        if (result.size() != n)
          wrong(i,
                "here should be " + std::to_string(n) + (n == 1 ? " number" : " numbers") + ", not <" + trim(lines[i]) +
                  ">");
        return result;
      }

      unsigned int
      whole_number(const std::string &word, const unsigned int least, const unsigned int most) const
      {
        const std::size_t i = find(word);
        const double      x = numbers(i, 1)[0];
        if (!(x >= least && x <= most) || x != std::floor(x))
          wrong(i,
                "<" + word + "> must be a whole number from " + std::to_string(least) + " to " + std::to_string(most));
        return x;
      }

      /** The next line that is not empty. */
      std::size_t
      skip_empty(std::size_t i) const
      {
        while (i < lines.size() && trim(lines[i]).empty())
          ++i;
        return i;
      }

      Matrix6
      matrix(std::size_t &i) const
      {
        i                             = skip_empty(i);
        const std::size_t   beginning = i;
        std::vector<double> all;
        for (unsigned int row = 0; row < 6; ++row, ++i)
          {
            const auto more = numbers(i, 6);
            all.insert(all.end(), more.begin(), more.end());
          }
        try
          {
            return from_beamdyn(symmetric_matrix(all));
          }
        catch (const std::invalid_argument &problem)
          {
            wrong(beginning, std::string("below: ") + problem.what());
          }
      }

      std::size_t
      size() const
      {
        return lines.size();
      }

    private:
      std::string              file;
      std::vector<std::string> lines;

      static std::string
      lower(std::string text)
      {
        for (char &c : text)
          c = std::tolower(static_cast<unsigned char>(c));
        return text;
      }
    };



    Vector6
    read_damping(const BeamDynReader &reader)
    {
      const unsigned int type = reader.whole_number("damp_type", 0, 2);
      if (type == 2)
        reader.wrong(reader.find("damp_type"),
                     "damping of modes (2) does not exist here: give 0, and the beam a <Damping ratio>");
      if (type == 0)
        return Vector6::Zero();
      const std::size_t line = reader.find("mu1") + 2; // names, units, numbers
      const auto        mu   = reader.numbers(line, 6);
      Vector6           result;
      for (int i = 0; i < 6; ++i)
        {
          result(i) = mu[in_beamdyn[i]];
          if (!(result(i) >= 0))
            reader.wrong(line, "a damping coefficient must not be negative");
        }
      return result;
    }



    void
    check_station(const BeamDynReader         &reader,
                  const std::size_t            line,
                  const BeamDynBlade::Station &station,
                  const double                 tolerance)
    {
      const std::string here = "the station at " + number_to_text(station.x);
      if (const std::string fault = fault_of({station.stiffness, station.inertia, {}}, here); !fault.empty())
        reader.wrong(line, fault);
      if (station.inertia.isZero(0.))
        return;
      if (const double distance = distance_to_a_section(station.inertia); !(distance <= tolerance))
        reader.wrong(line,
                     "the mass matrix of " + here +
                       " is not that of a plane section: I44 = " + number_to_text("%.6g", station.inertia(4, 4)) +
                       ", I55 = " + number_to_text("%.6g", station.inertia(5, 5)) +
                       ", I66 = " + number_to_text("%.6g", station.inertia(3, 3)) +
                       ", and I66 should be the sum of the others (in the axes of BeamDyn), with one mass and its two "
                       "first moments beside; it is off by " +
                       number_to_text("%.2g", distance) + " of it, <Inertia tolerance> is " +
                       number_to_text("%.2g", tolerance));
    }
  } // namespace



  BeamDynBlade
  BeamDynBlade::read(const std::string &file, const double tolerance)
  {
    const BeamDynReader reader(file);
    BeamDynBlade        result;
    result.damping             = read_damping(reader);
    const unsigned int n       = reader.whole_number("station_total", 2, 100000);
    std::size_t        i       = reader.find("distributed properties") + 1;
    constexpr double   of_ends = 1e-9;
    for (unsigned int k = 0; k < n; ++k)
      {
        i                      = reader.skip_empty(i);
        const std::size_t line = i;
        Station           station;
        station.x = reader.numbers(i++, 1)[0];
        if (k > 0 && !(station.x > result.stations.back().x))
          reader.wrong(line, "stations must follow each other in ascending order");
        if (const double end = k == 0 ? 0 : 1; (k == 0 || k + 1 == n) && std::abs(station.x - end) > of_ends)
          reader.wrong(line, k == 0 ? "the first station must be at 0" : "the last station must be at 1");
        station.stiffness = reader.matrix(i);
        station.inertia   = reader.matrix(i);
        check_station(reader, line, station, tolerance);
        result.stations.push_back(station);
      }
    if (i = reader.skip_empty(i); i < reader.size())
      reader.wrong(i, "there are more lines than those of " + std::to_string(n) + " stations");
    return result;
  }



  std::string
  BeamDynBlade::write(const std::string &title) const
  {
    std::ostringstream out;
    const auto         number = [](const double x) { return number_to_text(" %23.15E", x); };
    out << " ------- BEAMDYN V1.00.* INDIVIDUAL BLADE INPUT FILE --------------------------\n " << title
        << "\n ---------------------- BLADE PARAMETERS --------------------------------------\n"
        << stations.size() << "   station_total    - Number of blade input stations (-)\n"
        << (damping.isZero(0.) ? 0 : 1) << "   damp_type        - Damping type: 0: no damping; 1: damped\n"
        << "  ---------------------- DAMPING COEFFICIENT------------------------------------\n"
           "   mu1        mu2        mu3        mu4        mu5        mu6\n"
           "   (-)        (-)        (-)        (-)        (-)        (-)\n";
    Vector6 mu;
    for (int i = 0; i < 6; ++i)
      mu(in_beamdyn[i]) = damping(i);
    for (int i = 0; i < 6; ++i)
      out << number(mu(i));
    out << "\n ---------------------- DISTRIBUTED PROPERTIES---------------------------------\n";
    constexpr double width_of_jump = 1e-6;
    for (unsigned int k = 0; k < stations.size(); ++k)
      {
        const bool   is_before_jump = k + 1 < stations.size() && stations[k + 1].x <= stations[k].x;
        const double x              = stations[k].x - (is_before_jump ? width_of_jump : 0);
        out << number_to_text("  %.15f", x) << '\n';
        for (const Matrix6 *const A : {&stations[k].stiffness, &stations[k].inertia})
          {
            const Matrix6 B = to_beamdyn(*A);
            for (int i = 0; i < 6; ++i)
              {
                for (int j = 0; j < 6; ++j)
                  out << number(B(i, j));
                out << '\n';
              }
            out << '\n';
          }
      }
    return out.str();
  }



  void
  BeamDynSection::add_parameters(Parameters &prm)
  {
    prm.add_file(
      "File",
      file,
      "Blade file of BeamDyn: stations from 0 to 1 with stiffness and mass, and damping, which the beam then has. "
      "Axes x, y, z of BeamDyn are 2, 3, 1 of the section. Relative to the .prm file that says it.");
    prm.add(
      "Inertia tolerance",
      tolerance,
      "How far, relative to I66, a mass matrix of the file may be from that of a plane section, which has I44 + I55 = "
      "I66 [1].",
      dealii::Patterns::Double(0));
  }



  namespace
  {
    /** Two stations as near as jumps are written are a jump: they would be an element of that length otherwise. */
    void
    make_jumps(std::vector<SectionStations::Station> &stations, const std::string &file)
    {
      constexpr double near = 1e-5;
      for (std::size_t i = 1; i < stations.size(); ++i)
        {
          const double before = stations[i - 1].x;
          if (stations[i].x - before > near)
            continue;
          if (i == 1 || i + 1 == stations.size() || before <= stations[i - 2].x)
            throw std::invalid_argument(
              file + ": the stations at " + number_to_text(before) + " and " + number_to_text(stations[i].x) +
              " are nearer than 1e-5 of the blade, which is a jump: there can be none at an end, "
              "nor three stations at one place");
          stations[i - 1].x = stations[i].x;
        }
    }
  } // namespace



  void
  BeamDynSection::initialize(Model &model)
  {
    if (!parameters.require("File", model.complaints))
      return;
    try
      {
        blade = BeamDynBlade::read(file, tolerance);
        std::vector<SectionStations::Station> all;
        for (const auto &s : blade.stations)
          all.push_back({s.x, nullptr, {s.stiffness, s.inertia, drawn_outline({}, s.stiffness)}, 0.});
        make_jumps(all, file);
        stations = std::make_unique<SectionStations>(all);
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("File"), problem.what());
      }
  }



  SectionValues
  BeamDynSection::at(const double x, const Vector3 &curvature) const
  {
    return stations->at(x, curvature);
  }



  SectionValues
  BeamDynSection::at_side(const double x, const double inside, const Vector3 &curvature) const
  {
    return stations->at_side(x, inside, curvature);
  }



  std::vector<Eigen::Vector2d>
  BeamDynSection::outline(const double x) const
  {
    return stations->outline(x);
  }



  std::vector<double>
  BeamDynSection::kinks() const
  {
    return stations->kinks();
  }



  Vector6
  BeamDynSection::damping() const
  {
    return blade.damping;
  }
} // namespace samara
