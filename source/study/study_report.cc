#include <samara/base/text.h>
#include <samara/output/file.h>
#include <samara/output/table.h>
#include <samara/output/write_hdf5.h>
#include <samara/study/study.h>

#include <deal.II/base/convergence_table.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace samara
{
  double
  Study::cost_of(const StudyResult &result) const
  {
    return cost == "unknowns"   ? result.unknowns :
           cost == "steps"      ? result.steps :
           cost == "iterations" ? result.iterations :
                                  result.seconds;
  }



  void
  Study::report(const std::string &folder, Log &log) const
  {
    write_table(folder);
    std::ostringstream text;
    if (!title.empty())
      text << title << '\n';
    text << quantity_text << ", " << norm << "; " << error_kind << " error against "
         << (reference_member >= 0 ? "the finest run" : reference) << '\n';
    for (unsigned int i = 0; i < methods.size(); ++i)
      write_convergence(text, i);
    if (tolerance > 0)
      write_ladder(folder, text);
    replace_file(folder + "/study.txt", text.str());
    log.line("\n" + text.str());
  }



  void
  Study::write_table(const std::string &folder) const
  {
    const std::vector<std::pair<std::string, std::string>> numbers = {{"value", ""},
                                                                      {"unknowns", ""},
                                                                      {"steps", ""},
                                                                      {"iterations", ""},
                                                                      {"factorizations", ""},
                                                                      {"time", "s"},
                                                                      {"process time", "s"},
                                                                      {"quantity", ""},
                                                                      {"error", ""},
                                                                      {"rate", ""}};
    std::vector<std::string>                               header  = {"method", "member"};
    for (const auto &[name, unit] : numbers)
      header.push_back(unit.empty() ? name : name + " [" + unit + "]");
    header.insert(header.end(), {"role", "outcome"});

    Table                            table(header);
    std::vector<std::vector<double>> columns(numbers.size() + 1);
    for (unsigned int i = 0; i < members.size(); ++i)
      {
        const StudyMember        &member = members[i];
        const StudyResult        &r      = member.result;
        const std::vector<double> row    = {member.number,
                                            r.unknowns,
                                            r.steps,
                                            r.iterations,
                                            r.factorizations,
                                            r.seconds,
                                            r.cpu_seconds,
                                            r.value,
                                            r.error,
                                            r.rate};
        std::vector<Table::Cell>  cells  = {member.method < methods.size() ? methods[member.method]->name : "reference",
                                          member.label};
        // members that fail, and say so, have no numbers
        std::transform(row.begin(), row.end(), std::back_inserter(cells), Table::Cell::optional);
        cells.emplace_back(static_cast<int>(i) == reference_member ? "reference" : "");
        cells.emplace_back(r.finished ? "finished" : "fails: " + r.reason);
        table.add_row(cells);
        columns[0].push_back(member.method + 1);
        for (unsigned int c = 0; c < row.size(); ++c)
          columns[c + 1].push_back(row[c]);
      }
    table.write(folder + "/study.csv");

    auto names = numbers;
    names.insert(names.begin(), {"method", ""});
    write_hdf5(folder + "/study.h5", names, members.size(), [&](std::vector<std::vector<double>> &block) {
      block = columns;
    });
  }



  void
  Study::write_convergence(std::ostream &out, const unsigned int method) const
  {
    std::vector<const StudyMember *> rows;
    std::string                      failures, varied = "member";
    for (unsigned int i = 0; i < members.size(); ++i)
      {
        const StudyMember &member = members[i];
        if (member.method != method)
          continue;
        if (!member.label.empty())
          varied = trim(member.label.substr(0, member.label.find('=')));
        if (!member.result.finished)
          failures += "  " + (member.label.empty() ? "" : member.label + " ") + "fails: " + member.result.reason + '\n';
        else if (static_cast<int>(i) != reference_member)
          rows.push_back(&member);
      }

    // finer is more: rates are positive where the error falls
    const bool               falls = !rows.empty() && rows.back()->refinement() < rows.front()->refinement();
    dealii::ConvergenceTable table;
    for (const auto *const member : rows)
      {
        table.add_value(varied, member->value.empty() ? std::string("-") : member->value);
        table.add_value("unknowns", static_cast<unsigned int>(member->result.unknowns));
        table.add_value("steps", number_to_field(member->result.steps, 6));
        table.add_value("time [s]", number_to_field(member->result.seconds, 3));
        table.add_value("quantity", member->result.value);
        table.add_value("error", member->result.error);
        table.add_value("refinement", falls ? 1 / member->refinement() : member->refinement());
      }
    out << '\n' << methods[method]->name << '\n';
    if (!rows.empty())
      {
        table.set_precision("quantity", 10);
        table.set_scientific("error", true);
        table.set_precision("error", 3);
        if (rows.size() > 1)
          table.evaluate_convergence_rates("error", "refinement", dealii::ConvergenceTable::reduction_rate_log2, 1);
        std::vector<std::string> order = {varied, "unknowns", "steps", "time [s]", "quantity", "error"};
        table.set_column_order(order);
        table.write_text(out, dealii::TableHandler::table_with_headers);
      }
    out << failures;
  }



  void
  Study::write_ladder(const std::string &folder, std::ostream &out) const
  {
    Table                                                    table({"level",
                                                                    "member",
                                                                    "error",
                                                                    "unknowns",
                                                                    "time [s]",
                 cost == "time" ? "cost [s]" : "cost",
                                                                    "tolerance",
                                                                    "verdict"});
    const StudyMember                                       *cheapest = nullptr;
    std::vector<std::pair<const StudyMember *, std::string>> rows;
    for (unsigned int m = 0; m < methods.size(); ++m)
      {
        const StudyMember *best = nullptr, *nearest = nullptr;
        std::string        reason = "compared with itself";
        for (unsigned int i = 0; i < members.size(); ++i)
          {
            const StudyMember &member = members[i];
            if (member.method != m)
              continue;
            if (!member.result.finished)
              reason = "fails: " + member.result.reason;
            if (!std::isfinite(member.result.error))
              continue;
            if (nearest == nullptr || member.result.error < nearest->result.error)
              nearest = &member;
            if (member.result.error <= tolerance && (best == nullptr || cost_of(member.result) < cost_of(best->result)))
              best = &member;
          }
        const StudyMember *const shown = best != nullptr ? best : nearest;
        if (best != nullptr && (cheapest == nullptr || cost_of(best->result) < cost_of(cheapest->result)))
          cheapest = best;
        rows.emplace_back(shown, best != nullptr ? "meets" : shown != nullptr ? "misses" : reason);
      }
    for (unsigned int m = 0; m < methods.size(); ++m)
      {
        const auto &[member, verdict] = rows[m];
        const StudyResult nothing, &r = member != nullptr ? member->result : nothing;
        table.add_row({methods[m]->name,
                       member != nullptr ? member->label : "",
                       Table::Cell::optional(r.error),
                       Table::Cell::optional(r.unknowns),
                       Table::Cell::optional(r.seconds),
                       Table::Cell::optional(cost_of(r)),
                       tolerance,
                       member != nullptr && member == cheapest ? "cheapest" : verdict});
      }
    table.write(folder + "/study_ladder.csv");
    out << "\nLadder: " << error_kind << " error of at most " << number_to_text(tolerance)
        << "; of each level the cheapest member that meets it, or the nearest\n";
    table.print(out);
    if (cheapest == nullptr)
      out << "No level meets the tolerance.\n";
    else
      out << "The cheapest level that meets the tolerance: " << methods[cheapest->method]->name
          << (cheapest->label.empty() ? "" : ", " + cheapest->label) << '\n';
  }
} // namespace samara
