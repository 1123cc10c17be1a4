#include "io/config.hpp"

#include "temporary_folder.hpp"

namespace twindeck::io {
namespace {

struct Damper {
  std::string name;
  double damping_N_s_m = 1e3;
};

/// A configuration with every kind of field.
struct Sample {
  double modulus_Pa = 2.1e11, temperature_C = 10.0;
  long iterations = 50;
  bool scaled = true;
  std::string title = "untitled", variant = "preliminary";
  std::vector<double> masses_kg{1.0, 2.0};
  std::vector<std::string> groups;
  std::vector<Damper> dampers;

  FieldTable fields() {
    FieldTable table;
    table.number("E_s", modulus_Pa, "Pa", {0.0, 1e13, true}, "modulus of steel")
        .number("temperature", temperature_C, "degC", {-60.0, 80.0}, "of the air")
        .integer("solver.max_iterations", iterations, {1, 1000}, "at most")
        .boolean("scaled", scaled, "whether to scale")
        .text("title", title, "for reports")
        .choice("variant", variant, {"preliminary", "refined"}, "which model")
        .numbers("masses", masses_kg, "kg", positive(), "added masses")
        .texts("groups", groups, "names")
        .tables(
            "damper",
            [this] {
              Damper& damper = dampers.emplace_back();
              FieldTable element;
              element.text("name", damper.name, "its name", true)
                  .number("damping", damper.damping_N_s_m, "N s/m", non_negative(), "constant");
              return element;
            },
            "the dampers")
        .retired("old_scale", "is a key of an earlier version", "set masses instead");
    return table;
  }
};

class ConfigTest : public test::TemporaryFolder {
 protected:
  std::string load(const std::string& toml) {
    Sample sample;
    FieldTable table = sample.fields();
    return refusal([&] { table.load(write("c.toml", toml)); });
  }
  static std::string set(const std::string& assignment) {
    Sample sample;
    FieldTable table = sample.fields();
    try {
      table.set(assignment);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

const char* const kFull = R"(
E_s = "200 GPa"
temperature = "293.15 K"
scaled = false
title = "a \"quoted\" title"
variant = "refined"
masses = ["1 t", 5]
groups = ["a", "b"]
[solver]
max_iterations = 7
[[damper]]
name = "A1"
damping = "2 kN s/m"
[[damper]]
name = "A2"
[[damper]]
name = "A3"
)";

// Oracle: the words that the key is retired with.
TEST_F(ConfigTest, AKeyOfAnEarlierVersionIsRefusedWithWhatReplacesIt) {
  EXPECT_EQ(load("\nold_scale = 2\n"), "c.toml:2: old_scale: is a key of an earlier version; set masses instead");
  EXPECT_EQ(set("old_scale=2"), "--set: old_scale: is a key of an earlier version; set masses instead");
  Sample sample;
  EXPECT_EQ(sample.fields().print().find("old_scale"), std::string::npos);
}

// Oracle: the values written in kFull, converted by hand.
TEST_F(ConfigTest, ReadsEveryKindOfField) {
  Sample sample;
  sample.fields().load(write("c.toml", kFull));
  EXPECT_EQ(sample.modulus_Pa, 2e11);
  EXPECT_NEAR(sample.temperature_C, 20.0, 1e-12);
  EXPECT_EQ(sample.iterations, 7);
  EXPECT_FALSE(sample.scaled);
  EXPECT_EQ(sample.title, "a \"quoted\" title");
  EXPECT_EQ(sample.variant, "refined");
  EXPECT_EQ(sample.masses_kg, (std::vector<double>{1000.0, 5.0}));
  EXPECT_EQ(sample.groups, (std::vector<std::string>{"a", "b"}));
  ASSERT_EQ(sample.dampers.size(), 3u);
  EXPECT_EQ(sample.dampers[0].damping_N_s_m, 2000.0);
  EXPECT_EQ(sample.dampers[1].damping_N_s_m, 1000.0);
  EXPECT_EQ(sample.dampers[2].name, "A3");
}

// Oracle: print and load are inverse: what is printed reads back and prints the same text.
TEST_F(ConfigTest, PrintReadsBack) {
  Sample first, second;
  FieldTable one = first.fields(), two = second.fields();
  one.load(write("c.toml", kFull));
  two.load(write("d.toml", one.print()));
  EXPECT_EQ(one.print(), two.print());
  EXPECT_EQ(second.dampers.at(0).damping_N_s_m, 2000.0);
  EXPECT_EQ(second.title, first.title);
}

// Oracle: the messages as a user reads them.
TEST_F(ConfigTest, UnknownKeyNamesTheNearest) {
  EXPECT_EQ(load("\nEs = 3\n"), "c.toml:2: unknown key 'Es'; did you mean 'E_s'?");
  EXPECT_EQ(load("[solver]\nmax_iteration = 3\n"),
            "c.toml:2: unknown key 'solver.max_iteration'; did you mean 'solver.max_iterations'?");
  EXPECT_EQ(load("max_iterations = 3\n"), "c.toml:1: unknown key 'max_iterations'; did you mean 'solver.max_iterations'?");
  EXPECT_EQ(load("[[damper]]\nname = \"A\"\nnmae = \"B\"\n"),
            "c.toml:3: unknown key 'damper[0].nmae'; did you mean 'damper[0].name'?");
  EXPECT_TRUE(load("[zzz]\na = 3\n").starts_with("c.toml:1: unknown key 'zzz.a'; known keys are E_s, "));
  // The table is misspelt, and a key in it tells which one was meant; a word that is short beside its table is no match by that
  // alone.
  EXPECT_EQ(load("\n[slover]\nmax_iterations = 3\n"),
            "c.toml:2: unknown key 'slover.max_iterations'; did you mean 'solver.max_iterations'?");
  EXPECT_TRUE(load("[solver]\nabc = 3\n").starts_with("c.toml:2: unknown key 'solver.abc'; known keys are "));
}

TEST_F(ConfigTest, WrongUnitTypeOrRangeIsNamed) {
  EXPECT_EQ(load("E_s = \"3 kN\"\n"),
            "c.toml:1: E_s: is \"3 kN\", whose unit is of another kind than \"Pa\"; give it in Pa, kPa, MPa, GPa");
  EXPECT_EQ(load("E_s = \"-3 GPa\"\n"),
            "c.toml:1: E_s: is \"-3 GPa\" = -3000000000 Pa, expected a value in ]0, 10000000000000] Pa; choose a value in that "
            "range");
  EXPECT_TRUE(load("E_s = 0\n").starts_with("c.toml:1: E_s: is 0, expected a value in ]0, "));
  EXPECT_EQ(load("E_s = true\n"), "c.toml:1: E_s: is true, expected a number; write it like 1.5 or \"1.5 Pa\"");
  EXPECT_TRUE(load("E_s = nan\n").starts_with("c.toml:1: E_s: is nan, expected a finite number"));
  EXPECT_TRUE(load("E_s = inf\n").starts_with("c.toml:1: E_s: is inf, expected a finite number"));
  EXPECT_TRUE(
      load("[solver]\nmax_iterations = 2.5\n").starts_with("c.toml:2: solver.max_iterations: is 2.5, expected a whole"));
  EXPECT_TRUE(
      load("[solver]\nmax_iterations = 0\n").starts_with("c.toml:2: solver.max_iterations: is 0, expected a value in [1,"));
  EXPECT_TRUE(load("scaled = \"yes\"\n").starts_with("c.toml:1: scaled: is \"yes\", expected true or false"));
  EXPECT_EQ(load("variant = \"refind\"\n"),
            "c.toml:1: variant: is \"refind\" (did you mean 'refined'?); choose one of preliminary, refined");
  EXPECT_TRUE(load("masses = [1,\n -2]\n").starts_with("c.toml:2: masses[1]: is -2, expected a value > 0 kg"));
  EXPECT_TRUE(load("masses = 3\n").starts_with("c.toml:1: masses: is 3, expected an array of numbers"));
  EXPECT_EQ(load("solver = 3\n"), "c.toml:1: solver: is 3, expected a table; write [solver] and its keys below it");
  EXPECT_EQ(load("masses = [1, 1e300]\n"),
            "c.toml:1: masses[1]: is 1e+300, larger than any quantity of a structure; correct the value or its unit");
  EXPECT_TRUE(load("E_s = \"1e55 GPa\"\n").starts_with("c.toml:1: E_s: is \"1e55 GPa\", larger than any quantity"));
}

TEST_F(ConfigTest, MissingAndBrokenFilesAreNamed) {
  EXPECT_EQ(load("[[damper]]\ndamping = 3\n"), "c.toml:1: damper[0].name: is missing, a text is required; add it: its name");
  EXPECT_TRUE(load("E_s = \n").starts_with("c.toml:1: is no valid TOML"));
  Sample sample;
  FieldTable table = sample.fields();
  EXPECT_TRUE(refusal([&] { table.load(folder_ / "none.toml"); }).starts_with("none.toml: cannot be opened"));
}

// Oracle: the line of the file counted by hand; "--set" goes after the file; what was not given has no place.
TEST_F(ConfigTest, PlaceOfAKeyIsWhereItWasGiven) {
  Sample sample;
  FieldTable table = sample.fields();
  const auto file =
      write("c.toml", "title = \"a\"\n\ngroups = [\"a\"]\n[solver]\nmax_iterations = 3\n[[damper]]\nname = \"A\"\n");
  table.load(file);
  table.set("title=b");
  const auto place = [&](const char* key) {
    const auto at = table.place_of(key);
    return at ? at->file + ":" + std::to_string(at->line) : "unknown";
  };
  EXPECT_EQ(place("title"), "--set:0");
  EXPECT_EQ(place("groups"), file.string() + ":3");
  EXPECT_EQ(place("groups[0]"), file.string() + ":3");
  EXPECT_EQ(place("solver.max_iterations"), file.string() + ":5");
  EXPECT_EQ(place("max_iterations"), file.string() + ":5");
  EXPECT_EQ(place("damper.name"), file.string() + ":6");
  EXPECT_EQ(place("E_s"), ":0");
  EXPECT_EQ(place("mass"), "unknown");
}

// Oracle: a required key may come from --set; without it, require() refuses.
TEST_F(ConfigTest, RequireIsSatisfiedBySet) {
  double length = 0.0;
  FieldTable table;
  table.number("length", length, "m", positive(), "of the span", true);
  EXPECT_EQ(refusal([&] { table.require(); }), "length: is missing, a number is required; add it: of the span [m]");
  table.set("length=5 mm");
  EXPECT_EQ(refusal([&] { table.require(); }), "");
  EXPECT_EQ(length, 0.005);
}

// Oracle: the same checks as in a file; bare words are text.
TEST_F(ConfigTest, SetTakesTomlAndBareWords) {
  Sample sample;
  FieldTable table = sample.fields();
  for (const char* assignment :
       {"E_s=190 GPa", "variant=refined", "solver.max_iterations=9", "masses=[3, \"1 t\"]", "title=5", "scaled=false"}) {
    table.set(assignment);
  }
  EXPECT_EQ(sample.modulus_Pa, 1.9e11);
  EXPECT_EQ(sample.variant, "refined");
  EXPECT_EQ(sample.iterations, 9);
  EXPECT_EQ(sample.masses_kg, (std::vector<double>{3.0, 1000.0}));
  EXPECT_EQ(sample.title, "5");
  EXPECT_FALSE(sample.scaled);
  EXPECT_TRUE(set("Es=3").starts_with("--set: unknown key 'Es'; did you mean 'E_s'?"));
  EXPECT_TRUE(set("E_s=-3").starts_with("--set: E_s: is -3, expected a value in ]0"));
  EXPECT_TRUE(set("E_s").starts_with("--set: got 'E_s', expected key=value"));
  EXPECT_TRUE(set("damper=[]").starts_with("--set: damper: is an array of tables"));
}

// Oracle: describe tells meaning, unit, range and default as bound, whatever was loaded since.
TEST_F(ConfigTest, DescribeTellsMeaningUnitRangeDefault) {
  Sample sample;
  FieldTable table = sample.fields();
  table.set("temperature=30");
  EXPECT_EQ(table.describe("temperature"), "temperature: of the air\n    number [degC], in [-60, 80], default 10\n");
  EXPECT_EQ(table.describe("damper.name"), "name: its name\n    text, required\n");
  EXPECT_NE(table.describe().find("one of preliminary, refined"), std::string::npos);
  EXPECT_TRUE(refusal([&] { static_cast<void>(table.describe("temprature")); }).find("did you mean 'temperature'?") !=
              std::string::npos);
}

// Oracle: the messages as a user reads them, with the lines of both elements.
TEST_F(ConfigTest, TwoElementsOfOneNameAreRefused) {
  const auto events = [&](const std::string& toml) {
    std::vector<std::string> names;
    names.reserve(4);
    FieldTable table;
    table.tables(
        "event",
        [&names] {
          FieldTable element;
          element.text("name", names.emplace_back(), "its name", true);
          return element;
        },
        "events", "name");
    return refusal([&] { table.load(write("c.toml", toml)); });
  };
  EXPECT_EQ(events("[[event]]\nname = \"April\"\n[[event]]\nname = \"May\"\n"), "");
  EXPECT_EQ(
      events("[[event]]\nname = \"April\"\n[[event]]\nname = \"May\"\n[[event]]\nname = \"April\"\n"),
      "c.toml:6: event[2].name: is \"April\", as on line 2; give each [[event]] a name of its own, or remove one of the two");
  EXPECT_EQ(load("[[damper]]\nname = \"A\"\n[[damper]]\nname = \"A\"\n"), "");  // where nobody asked for it
}

// Oracle: the rule of `choice`, for each text of an array.
TEST_F(ConfigTest, EachOfSeveralChoicesIsChecked) {
  std::vector<std::string> models = {"A"};
  FieldTable table;
  table.choices("models", models, {"A", "C", "hybrid"}, "models");
  table.set("models=[\"C\", \"hybrid\"]");
  EXPECT_EQ(models, (std::vector<std::string>{"C", "hybrid"}));
  EXPECT_EQ(refusal([&] { table.set("models=[\"C\", \"hybrd\"]"); }),
            "--set: models[1]: is \"hybrd\" (did you mean 'hybrid'?); choose one of A, C, hybrid");
  EXPECT_EQ(models, (std::vector<std::string>{"C", "hybrid"}));
  EXPECT_NE(table.describe("models").find("array of texts, each one of A, C, hybrid, default [\"A\"]"), std::string::npos);
}

// Oracle: a rule between keys is checked when all are read, at the place of the key that it blames.
TEST_F(ConfigTest, ARuleBetweenKeysIsCheckedAtTheEnd) {
  long least = 2, most = 10;
  FieldTable table;
  table.integer("least", least, {1, 100}, "least")
      .integer("most", most, {1, 100}, "most")
      .rule([&]() -> std::optional<FieldTable::Broken> {
        if (least <= most) return std::nullopt;
        return FieldTable::Broken{"most", "is below least", "raise it"};
      });
  const auto file = write("c.toml", "least = 5\nmost = 3\n");
  table.load(file);
  EXPECT_EQ(refusal([&] { table.require(); }), "c.toml:2: most: is below least; raise it");
  table.set("most=4");
  EXPECT_EQ(refusal([&] { table.require(); }), "--set: most: is below least; raise it");
  table.set("most=5");
  EXPECT_EQ(refusal([&] { table.require(); }), "");
}

// Oracle: two bindings of one key are a mistake of ours.
TEST_F(ConfigTest, AKeyBoundTwiceIsOurMistake) {
  bool a = false;
  FieldTable table;
  table.boolean("a", a, "x");
  EXPECT_THROW(table.boolean("a", a, "x"), InternalError);
}

}  // namespace
}  // namespace twindeck::io
