#include <samara/base/number_in_file.h>
#include <samara/base/text.h>
#include <samara/cosserat/section_file.h>
#include <samara/rotation/matrix6.h>
#include <samara/section/section_constants.h>
#include <samara/section/symmetric_matrix.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace samara
{
  namespace
  {
    const std::string stiffness_block = "Stiffness", inertia_block = "Inertia", outline_block = "Outline",
                      curvature_line = "Initial twist and curvature", trapeze_line = "Trapeze";

    bool
    starts_with(const std::string &text, const std::string &beginning)
    {
      return text.compare(0, beginning.size(), beginning) == 0;
    }



    void
    write_block(std::ostream &out, const std::string &title, const Eigen::MatrixXd &A, const int digits)
    {
      out << '\n' << title << '\n' << std::scientific << std::setprecision(digits);
      for (int i = 0; i < A.rows(); ++i)
        {
          for (int j = 0; j < A.cols(); ++j)
            out << std::setw(digits + 9) << A(i, j);
          out << '\n';
        }
    }



    /** The lines of a file, and what is to be said of one of them. */
    class SectionLines
    {
    public:
      explicit SectionLines(const std::string &file)
        : file(file)
      {
        std::ifstream in(file);
        if (!in)
          throw std::invalid_argument("cannot read the file " + file);
        for (std::string line; std::getline(in, line);)
          all.push_back(trim(line.substr(0, line.find('#'))));
      }

      [[noreturn]] void
      wrong(const std::size_t i, const std::string &what) const
      {
        throw std::invalid_argument(file + ":" + std::to_string(i + 1) + ": " + what);
      }

      /** The numbers of line @p i; nothing if there is a word among them. */
      std::vector<double>
      numbers(const std::size_t i, const std::size_t from = 0) const
      {
        std::istringstream  words(all[i].substr(from));
        std::vector<double> result;
        for (std::string word; words >> word;)
          {
            double x = 0;
            if (!fault_of_number(word, x).empty())
              return {};
            result.push_back(x);
          }
        return result;
      }

      /** The numbers below line @p i, @p n each line; @p i is then the last of them. */
      std::vector<double>
      block(std::size_t &i, const std::size_t n) const
      {
        std::vector<double> result;
        for (; i + 1 < all.size() && !all[i + 1].empty(); ++i)
          {
            const auto more = numbers(i + 1);
            if (more.size() != n)
              wrong(i + 1, "here should be " + std::to_string(n) + " numbers, not <" + all[i + 1] + ">");
            result.insert(result.end(), more.begin(), more.end());
          }
        return result;
      }

      Matrix6
      matrix(std::size_t &i) const
      {
        const std::size_t title   = i;
        const auto        numbers = block(i, 6);
        if (numbers.size() != 36)
          wrong(title, "below this line there should be 6 lines of 6 numbers");
        try
          {
            return symmetric_matrix(numbers);
          }
        catch (const std::invalid_argument &problem)
          {
            wrong(title, problem.what());
          }
      }

      std::vector<std::string> all;

    private:
      std::string file;
    };



    /** A line <name [unit] number>. */
    struct RemarkOfFile
    {
      std::string name;
      double      number;
      std::size_t line;
    };



    /** Numbers for people, where there are some, are those of the matrices: who edits them edits in vain. */
    void
    check_remarks(const SectionLines &lines, const std::vector<RemarkOfFile> &remarks, const SectionValues &values)
    {
      const SectionConstants constants(inverse6(values.stiffness), values.inertia);
      const double           size = std::sqrt(constants.principal_bending.larger / constants.EA);
      for (const auto &known : constants.list())
        for (const auto &remark : remarks)
          if (remark.name == known.name)
            {
              // an angle is one of axes that two nearly equal numbers have nearly everywhere
              const bool   is_length = known.unit == "m", is_angle = known.unit == "deg";
              const double difference = remark.number - known.number;
              const bool   is_same    = is_angle ?
                                          std::abs(std::remainder(difference, 180.)) < 0.1 || known.is_vague :
                                          std::abs(difference) <= 1e-6 * (is_length ? size : std::abs(known.number));
              if (!is_same)
                lines.wrong(remark.line,
                            "<" + known.name + "> is " + number_to_text(remark.number) +
                              " here, and that of the matrices below is " + number_to_text(known.number) +
                              ": the matrices count; change them, or leave out this line");
            }
    }
  } // namespace



  std::string
  SectionFile::write(const int digits) const
  {
    std::ostringstream out;
    out << "Section " << name << "\n\n" << curvature_line << " [1/m]:" << std::scientific << std::setprecision(digits);
    for (int i = 0; i < 3; ++i)
      out << ' ' << curvature(i);
    out << "\n\n";
    const auto line = [&](const std::string &what, const std::string &unit, const double number) {
      if (number == number)
        out << "  " << std::left << std::setw(38) << (unit.empty() ? what : what + " [" + unit + "]") << std::right
            << number_to_text("%.10g", number) << '\n';
    };
    for (const auto &[remark, number] : remarks)
      line(remark, "", number);
    for (const auto &known : SectionConstants(inverse6(values.stiffness), values.inertia).list())
      line(known.name, known.unit, known.number);
    write_block(out,
                stiffness_block + ": F1 F2 F3 M1 M2 M3 from Gamma1 Gamma2 Gamma3 K1 K2 K3 [N, N m, N m^2]",
                values.stiffness,
                digits);
    write_block(out, inertia_block + " per length about the reference line [kg/m, kg, kg m]", values.inertia, digits);
    if (values.trapeze.is_there())
      {
        out << '\n'
            << trapeze_line
            << " effect, coupling to Gamma1 Gamma2 Gamma3 K1 K2 K3, then stiffness [N m^2, N m^3, N m^4]:";
        for (int i = 0; i < 6; ++i)
          out << ' ' << values.trapeze.coupling(i);
        out << ' ' << values.trapeze.stiffness << '\n';
      }
    if (!values.outline.empty())
      {
        Eigen::MatrixXd corners(values.outline.size(), 2);
        for (unsigned int i = 0; i < values.outline.size(); ++i)
          corners.row(i) = values.outline[i].transpose();
        write_block(out, outline_block + ", axes 2 and 3 [m]", corners, digits);
      }
    return out.str();
  }



  namespace
  {
    /** The @p n numbers behind the colon of line @p i. */
    std::vector<double>
    behind_colon(const SectionLines &lines, const std::size_t i, const std::size_t n, const std::string &how_many)
    {
      const std::string        &line    = lines.all[i];
      const std::vector<double> numbers = lines.numbers(i, std::min(line.find(':'), line.size() - 1) + 1);
      if (numbers.size() != n)
        lines.wrong(i, "here should be " + how_many + " numbers behind a colon");
      return numbers;
    }
  } // namespace



  SectionFile
  SectionFile::read(const std::string &file)
  {
    const SectionLines        lines(file);
    SectionFile               result;
    std::vector<RemarkOfFile> remarks;
    bool                      has_stiffness = false, has_inertia = false;
    const auto                only_once = [&](const std::size_t i, bool &has) {
      if (has)
        lines.wrong(i, "this block is there twice");
      has = true;
    };
    for (std::size_t i = 0; i < lines.all.size(); ++i)
      {
        const std::string &line = lines.all[i];
        if (starts_with(line, stiffness_block))
          {
            only_once(i, has_stiffness);
            result.values.stiffness = lines.matrix(i);
          }
        else if (starts_with(line, inertia_block))
          {
            only_once(i, has_inertia);
            result.values.inertia = lines.matrix(i);
          }
        else if (starts_with(line, outline_block))
          {
            const auto corners = lines.block(i, 2);
            for (std::size_t k = 0; k < corners.size(); k += 2)
              result.values.outline.emplace_back(corners[k], corners[k + 1]);
          }
        else if (starts_with(line, curvature_line))
          {
            const auto numbers = behind_colon(lines, i, 3, "three");
            result.curvature   = Eigen::Map<const Vector3>(numbers.data());
          }
        else if (starts_with(line, trapeze_line))
          {
            const auto numbers    = behind_colon(lines, i, 7, "seven");
            result.values.trapeze = {Eigen::Map<const Vector6>(numbers.data()), numbers[6]};
          }
        else if (starts_with(line, "Section "))
          result.name = trim(line.substr(8));
        else if (const auto space = line.find_last_of(" \t"); space != std::string::npos)
          {
            double number = 0;
            if (!text_to_number(line.substr(space + 1), number))
              number = std::nan("");
            remarks.push_back({trim(line.substr(0, std::min(line.find('['), space))), number, i});
          }
      }
    for (const auto &[has, block] : {std::pair(has_stiffness, stiffness_block), std::pair(has_inertia, inertia_block)})
      if (!has)
        throw std::invalid_argument(file + ": there is no line that begins with <" + block +
                                    "> and has 6 lines of 6 numbers below it");
    if (const std::string fault = fault_of(result.values, "the section"); !fault.empty())
      throw std::invalid_argument(file + ": " + fault);
    check_remarks(lines, remarks, result.values);
    if (result.values.outline.size() < 3)
      result.values.outline = drawn_outline({}, result.values.stiffness);
    return result;
  }



  void
  FileSection::add_parameters(Parameters &prm)
  {
    prm.add_file("File",
                 file,
                 "Text with the stiffness and the inertia of a section, as <Analyses = section> writes it: "
                 "section_<name>.txt. Relative to the .prm file that says it.");
    prm.add(
      "Initial curvature",
      for_curvature,
      "For which twist and curvature of the reference line the section may be used: those that the file says, or any.",
      dealii::Patterns::Selection("of the file|any"));
  }



  void
  FileSection::initialize(Model &model)
  {
    if (!parameters.require("File", model.complaints))
      return;
    try
      {
        own = SectionFile::read(file);
        for (const auto &corner : own.values.outline)
          size = std::max(size, corner.norm());
      }
    catch (const std::invalid_argument &problem)
      {
        model.complaints.add(parameters.where("File"), problem.what());
      }
  }



  bool
  FileSection::depends_on_curvature() const
  {
    return for_curvature != "any";
  }



  SectionValues
  FileSection::at(const double, const Vector3 &curvature) const
  {
    constexpr double same = 1e-4; // stiffnesses change by a few times the curvature times the size
    if (depends_on_curvature() && !((curvature - own.curvature).norm() * size < same))
      {
        const auto text = [](const Vector3 &k) {
          return number_to_text("%.6g", k(0)) + ", " + number_to_text("%.6g", k(1)) + ", " +
                 number_to_text("%.6g", k(2));
        };
        throw std::invalid_argument("the file " + file + " is of a section with initial twist and curvature " +
                                    text(own.curvature) + " 1/m, and the reference line has " + text(curvature) +
                                    " 1/m here: say <Initial curvature = any> to use it all the same");
      }
    return own.values;
  }



  std::vector<Vector3>
  FileSection::curvatures() const
  {
    return {own.curvature};
  }



  std::vector<Eigen::Vector2d>
  FileSection::outline(const double) const
  {
    return own.values.outline;
  }
} // namespace samara
