#include "steps/identification/inputs.hpp"

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "identification/stays.hpp"
#include "io/csv.hpp"
#include "model_io/modes_io.hpp"
#include "records/universal_modes.hpp"
#include "steps/shared/config_parts.hpp"

namespace twindeck::steps {
namespace {

/// data/<study>/campaign where somebody has put records of their own, else what s0_campaign wrote.
std::filesystem::path default_campaign(const runner::StepContext& context) {
  const std::filesystem::path own = std::filesystem::path("data") / context.study.lexically_normal().filename() / "campaign";
  if (!context.study.empty() && std::filesystem::exists(own / "campaign.toml")) return own;
  const std::filesystem::path simulated = context.results / "s0_campaign";
  if (!context.study.empty() && !std::filesystem::exists(simulated))
    throw InputError({own.string() + "/campaign.toml", 0, ""}, "does not exist, nor does " + simulated.string(),
                     "put your records there (docs/my_records.md), or run s0_campaign; whoever has modes and no records takes "
                     "s3_identification out of the steps in study.toml");
  return simulated;
}

/// Registers the lists and the records as inputs; other files of the folder are ignored.
records::Campaign read_lists(runner::StepContext& context) {
  const auto folder = context.campaign ? *context.campaign : default_campaign(context);
  if (!std::filesystem::exists(folder)) context.input(folder);
  records::Campaign campaign = records::read_campaign(folder);
  for (const std::string& warning : campaign.warnings) context.say(warning);
  for (const char* name : {"campaign.toml", "channels.csv", "conditions.toml"})
    if (std::filesystem::exists(folder / name)) context.input(folder / name);
  for (const records::CampaignRecord& record : campaign.records)
    if (std::filesystem::exists(record.file)) context.record(record.file);
  return campaign;
}

/// Collects records that cannot be used, with the reasons.
class LeftOut {
 public:
  template <typename Read>
  void attempt(const std::string& what, const Read& read) {
    try {
      read();
    } catch (const identification::UnusableRecord& problem) {
      if (!first_) first_ = problem;
      warnings_.push_back(what + " is left out: " + problem.what());
    }
  }
  /// Warns of each, or refuses with the first where nothing else is left to identify.
  void report(runner::StepContext& context, bool nothing_left) const {
    if (nothing_left && first_) throw *first_;
    for (const std::string& warning : warnings_) context.warn(warning);
  }

 private:
  std::optional<identification::UnusableRecord> first_;
  std::vector<std::string> warnings_;
};

std::vector<identification::Conditioned> read_kind(const records::Campaign& campaign, const records::RecordChoice& choice,
                                                   const identification::IdentificationSettings& config,
                                                   runner::StepContext& context, LeftOut& left_out) {
  std::vector<identification::Conditioned> records;
  for (const records::RecordGroup& group : records::record_groups(campaign, choice, true))
    left_out.attempt("setup " + group.setup, [&] {
      records.push_back(identification::condition_records(campaign, group, config));
      for (const std::string& note : records.back().notes) context.say(note);
      for (const std::string& warning : records.back().warnings) context.warn(warning);
    });
  return records;
}

/// Kind of the records that give the modes of the structure: as configured. For a campaign without ambient records these are
/// its frequency response functions, else its free decays, otherwise its stays.
std::string main_kind(const records::Campaign& campaign, const identification::IdentificationSettings& config) {
  const auto has = [&](const std::string& kind) {
    return std::ranges::any_of(campaign.records, [&](const records::CampaignRecord& record) { return record.kind == kind; });
  };
  const bool others = std::ranges::any_of(campaign.records, [](const records::CampaignRecord& record) {
    return record.kind != "stay" && record.kind != "free_decay" && record.kind != records::kFrfKind;
  });
  if (config.kind != "ambient" || others) return config.kind;
  return has(records::kFrfKind) ? records::kFrfKind : has("free_decay") ? "free_decay" : has("stay") ? "stay" : config.kind;
}

identification::IdentificationSettings decay_settings(const identification::IdentificationSettings& config) {
  identification::IdentificationSettings own = config;
  if (config.decay_decimation > 0) own.decimation = config.decay_decimation;
  own.block_rows = config.decay_block_rows;
  return own;
}

}  // namespace

std::vector<identification::ModeChoice> read_mode_choices(const std::string& file, runner::StepContext& context) {
  std::vector<identification::ModeChoice> choices;
  if (file.empty()) return choices;
  const auto table = io::CsvTable::read(context.input(context.resolved(file)),
                                        {"setup", "order", "frequency_Hz", "damping_ratio_pct", "action"}, {}, true);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::string action = table.text(row, "action");
    if (action != "keep" && action != "delete")
      table.fail(row, "action", "is '" + action + "', expected keep or delete", "write one of them");
    identification::ModeChoice choice{.setup = table.text(row, "setup"),
                                      .order = static_cast<int>(table.integer(row, "order")),
                                      .frequency_Hz = table.number(row, "frequency_Hz"),
                                      .damping_ratio = 0.01 * table.number(row, "damping_ratio_pct"),
                                      .keep = action == "keep",
                                      .file = table.file().string(),
                                      .line = table.line(row)};
    if (!(choice.frequency_Hz > 0.0))
      table.fail(row, "frequency_Hz", "is " + table.text(row, "frequency_Hz") + ", expected a frequency above 0",
                 "take it from poles.csv");
    choices.push_back(std::move(choice));
  }
  return choices;
}

IdentificationInputs read_identification_inputs(const identification::IdentificationSettings& config,
                                                runner::StepContext& context) {
  IdentificationInputs read;
  read.campaign = read_lists(context);
  LeftOut left_out;
  const std::string kind = main_kind(read.campaign, config);
  read.decays_are_main = kind == "free_decay";
  const records::RecordChoice chosen{config.setup, config.condition, kind, config.setups};
  const bool stays_alone = kind == "stay";
  if (stays_alone) {
    static_cast<void>(records::record_groups(read.campaign, {"", "", "stay", {}}));  // refuses where there is none
    context.say("stays alone are identified: stays.csv and stay_tensions.csv; modes.csv stays empty");
  } else {
    const std::vector<records::RecordGroup> groups = records::record_groups(read.campaign, chosen);
    if (read.decays_are_main) context.say("the modes are those of the free decays, by ERA");
    if (kind == records::kFrfKind)
      context.say(
          "the modes are those of the frequency response functions: poles by pLSCF, then a modal model fitted to them; "
          "standard deviations from its residuals");
    else if (const auto& is = config.condition;
             !records::record_groups(read.campaign, {"", is, records::kFrfKind, {}}, true).empty())
      context.warn(
          "the campaign's frequency response functions are not used beside its time series; --set kind=frf identifies them");
    for (const std::vector<records::RecordGroup>& one : records::by_condition(groups)) {
      if (read.decays_are_main) break;
      left_out.attempt("condition " + one.front().condition,
                       [&] { read.conditions.push_back(identification::read_condition(read.campaign, one, config, context)); });
    }
  }
  const records::RecordChoice all_decays{"", config.condition, "free_decay", {}};
  read.decays = read_kind(read.campaign, read.decays_are_main ? chosen : all_decays, decay_settings(config), context, left_out);
  read.stays = read_kind(read.campaign, {"", "", "stay", {}}, identification::stay_settings(config), context, left_out);
  const bool nothing_left = stays_alone            ? read.stays.empty()
                            : read.decays_are_main ? read.decays.empty()
                                                   : read.conditions.empty();
  left_out.report(context, nothing_left);
  return read;
}

std::optional<runner::Computation> imported_modes(double std_pct, runner::StepContext& context) {
  if (!context.modes) return std::nullopt;
  if (std::filesystem::is_directory(*context.modes))
    throw InputError({context.modes->string(), 0, ""}, "is a folder, expected a universal file with modes",
                     "give the folder to the step that compares with it: s4_refinement --modes DIR");
  records::UniversalModes read = records::read_universal_modes(context.record(*context.modes), std_pct);
  for (const std::string& note : read.notes) context.say(context.modes->string() + ": " + note);
  if (std_pct == 0.0)
    context.warn(context.modes->string() +
                 ": has no standard deviations, and steps 4, 6 and 9 refuse modes without them; state what you assume, for "
                 "example --set imported_std_pct=0.5");
  return [read = std::move(read), &context]() -> Status {
    model_io::write_modes(read.modes, context.out);
    records::write_channels(read.channels, context.out / "channels.csv");
    return {};
  };
}

io::FieldTable IdentificationConfig::fields() {
  io::FieldTable table;
  table.text("setup", setup, "setup whose records are used; empty: all, merged over the reference channels")
      .texts("setups", setups, "setups that are merged; empty: all, or the one named by `setup`")
      .text("condition", condition, "condition whose records are used; empty: all, and modes.csv holds the modes of the first")
      .text("kind", kind,
            "kind of the records: ambient, wind, earthquake or another with broadband excitation; free_decay: identified by "
            "ERA; frf: frequency response functions, by pLSCF; stay: stays only")
      .choice("method", method, {"covariance", "data"},
              "subspace identification from correlations or from the data; measured inputs are used")
      .choice("selection", selection, {"automatic", "paper"}, "rule that selects the modes: automatic, or paper Eqs. (3)-(4)")
      .choice("merge", merge, {"poser", "preger"}, "setups are merged after identification (poser) or before it (preger)")
      .texts("references", references, "reference channels; empty: those marked in channels.csv, or all")
      .texts("exclude", exclude, "channels that are left out")
      .text("keep", keep,
            "CSV file of the poles that a person kept or deleted (setup,order,frequency_Hz,damping_ratio_pct,action); the "
            "report's stabilisation diagram writes it; empty: none")
      .number("imported_std_pct", imported_std_pct, "", {0.0, 50.0},
              "standard deviation in per cent that is assumed for the frequencies of a universal file (--modes FILE); 0: none")
      .integer("longest_gap", longest_gap, io::non_negative(), "most missing samples in a row that a straight line replaces")
      .number("largest_clipping", largest_clipping, "", {0.0, 1.0},
              "largest share of clipped samples in a channel: samples at its largest or smallest value, three or more in a row "
              "or far more often than the next values")
      .number("largest_lone", largest_lone, "", {10.0, 1e300},
              "largest distance of a single sample from the median between quiet neighbours, in robust standard deviations")
      .integer("decimation", decimation, {0.0, 1000.0},
               "factor by which the sampling rate is reduced, after a zero-phase low-pass filter; 0: chosen from the highest "
               "peak of the spectrum")
      .number("band.lowest", lowest_Hz, "Hz", io::non_negative(), "poles below this frequency are left out")
      .number("band.highest", highest_Hz, "Hz", io::non_negative(),
              "poles above this frequency are left out; 0: the limit up to which the sensors move together, at most 0.8 of the "
              "Nyquist frequency, or all of it if an undecimated record has a peak above")
      .integer(
          "block_rows", block_rows, {0.0, 500.0},
          "block rows of the Toeplitz or Hankel matrix, which uses twice as many lags; 0: three periods of the lowest peak")
      .integer("minimum_order", minimum_order, {2.0, 500.0}, "smallest model order")
      .integer("maximum_order", maximum_order, {2.0, 500.0}, "largest model order")
      .integer("order_step", order_step, {1.0, 100.0}, "step between model orders")
      .integer("blocks", blocks, {2.0, 1000.0}, "blocks of a record, whose scatter gives the standard deviations")
      .integer("welch_segment", welch_segment, {8.0, 1e7}, "samples of a Welch segment, after decimation")
      .number("stable.frequency", criteria.frequency, "", io::positive(),
              "paper 3.1: largest relative change of a stable frequency between orders")
      .number("stable.damping", criteria.damping, "", io::positive(),
              "paper 3.1: largest change of a stable damping ratio between orders (0.01 = 1 % of critical)")
      .number("stable.mac", criteria.mac, "", {0.0, 1.0}, "paper 3.1: least MAC of a stable shape between orders")
      .number("largest_damping", largest_damping, "", {0.0, 1.0, true}, "poles with a larger damping ratio are left out")
      .number("cleaning.mac", cleaning.mac, "", {0.0, 1.0}, "paper Eq. (3): least MAC of two shapes that count as the same")
      .number("cleaning.frequency", cleaning.frequency, "", io::positive(),
              "largest relative distance of two frequencies that count as the same")
      .number("cleaning.recursion", cleaning.recursion, "", io::non_negative(),
              "paper Eq. (4): recursion index that a mode must exceed")
      .number("cleaning.share", cleaning.share, "", {0.0, 1.0},
              "least share of orders with the mode, counted from its first order; 0: the paper's rule")
      .number("cleaning.deviation", largest_deviation, "", io::non_negative(),
              "largest relative standard deviation of a mode's frequency; the automatic rule allows more for a short record; "
              "0: any (the paper's rule as printed)")
      .number("automatic.collinearity", automatic.collinearity, "", {0.0, 1.0},
              "automatic rule: smallest modal phase collinearity")
      .number("automatic.share", automatic.share, "", {0.0, 1.0},
              "automatic rule: least share of orders with the mode, counted from its first order")
      .number("automatic.law_ratio", largest_law_ratio, "", io::non_negative(),
              "automatic rule: largest standard deviation of a frequency, as a multiple of the least one possible with the "
              "record's length; 0: any")
      .number("automatic.shape_deviation", largest_shape_deviation, "", io::non_negative(),
              "automatic rule: largest standard deviation of a mode shape of unit norm; 0: any")
      .integer("decay.decimation", decay_decimation, {0.0, 1000.0}, "free decays: factor of decimation; 0: as decimation")
      .integer("decay.block_rows", decay_block_rows, {0.0, 1000.0},
               "free decays: block rows of the Hankel matrix; 0: half a period of the lowest peak")
      .integer("decay.maximum_order", decay_maximum_order, {2.0, 500.0}, "free decays: largest model order")
      .number("decay.start", decay_start_s, "s", {0.0, io::longest_record_s},
              "free decays: time after the release at which reading begins")
      .number("decay.length", decay_length_s, "s", {0.0, io::longest_record_s},
              "free decays: length that is read; 0: until the motion has decayed to the level at the end of the record")
      .number("decay.band", decay_band_Hz, "Hz", io::positive(),
              "free decays: half width of the filter that isolates a mode, for frequency and damping against amplitude")
      .integer("decay.bands", decay_bands, {1.0, 50.0}, "free decays: number of amplitude bands")
      .integer("stay.decimation", stay_decimation, {0.0, 1000.0}, "stays: factor of decimation; 0: chosen")
      .integer("stay.block_rows", stay_block_rows, {0.0, 1000.0}, "stays: block rows; 0: chosen")
      .integer("stay.maximum_order", stay_maximum_order, {2.0, 500.0}, "stays: largest model order")
      .integer("stay.harmonics", stay_harmonics, {2.0, 40.0}, "stays: largest number of harmonics that are used")
      .number("stay.lowest", stay_lowest_Hz, "Hz", io::non_negative(),
              "stays: lowest fundamental frequency of the taut string that is considered")
      .number("stay.highest", stay_highest_Hz, "Hz", io::non_negative(),
              "stays: highest fundamental frequency of the taut string that is considered; 0: any")
      .number("stay.level", stay_level, "", {0.5, 0.9999}, "stays: probability of the intervals of tension and sag")
      .tables(
          "stay_length",
          rows_of(stays,
                  [](io::FieldTable& entry, identification::StaySettings& stay) {
                    entry.text("name", stay.name, "name of the setup, point or channel of the stay's records", true)
                        .number("length", stay.length_m, "m", io::positive(), "free length", true)
                        .choice("ends", stay.ends, {"unknown", "hinged", "clamped"},
                                "how the ends are held; unknown: both are compared")
                        .number(
                            "bending_stiffness", stay.bending_stiffness_N_m2, "N m^2", io::non_negative(),
                            "bending stiffness EI of the section, assumed known to ten per cent; 0: fitted to the harmonics")
                        .number("mass", stay.mass_kg_m, "kg/m", io::non_negative(),
                                "mass per length, required with bending_stiffness");
                  }),
          "length and ends of a stay; without them its tension is not computed", "name")
      .rule([this] { return orders_exchanged("", minimum_order, maximum_order); })
      .rule([this]() -> std::optional<io::FieldTable::Broken> {
        if (block_rows != 1) return std::nullopt;
        return io::FieldTable::Broken{"block_rows", "is 1, expected 2 or more, or 0", "leave it out, and the step chooses it"};
      })
      .rule([this]() -> std::optional<io::FieldTable::Broken> {
        for (const identification::StaySettings& stay : stays)
          if (stay.bending_stiffness_N_m2 > 0.0 && stay.mass_kg_m <= 0.0)
            return io::FieldTable::Broken{"stay_length.bending_stiffness",
                                          "of " + stay.name + " is given without a mass, expected both",
                                          "give mass in kg/m too, or leave bending_stiffness out"};
        return std::nullopt;
      });
  return table;
}

}  // namespace twindeck::steps
