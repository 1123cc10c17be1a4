#include "io/manifest.hpp"

#include "temporary_folder.hpp"

namespace twindeck::io {
namespace {

class ManifestTest : public test::TemporaryFolder {
 protected:
  /// A step's folder with two outputs, vouched for.
  std::filesystem::path finished_step() {
    write("s1_model/modes.csv", "mode,frequency_Hz\n1,0.5\n");
    write("s1_model/model/nodes.csv", "node\n1\n");
    Manifest manifest;
    manifest.step = "s1_model";
    manifest.message = "all well";
    manifest.config_toml = "a = 1\n";
    manifest.command_line = {"s1_model", "--quiet"};
    manifest.seed = 18446744073709551615u;
    manifest.threads = 2;
    manifest.seconds = 1.5;
    manifest.inputs["data/bridge.toml"] = "ab";
    for (const char* name : {"modes.csv", "model/nodes.csv"}) manifest.outputs[name] = sha256(folder_ / "s1_model" / name);
    write_manifest(manifest, folder_ / "s1_model");
    return folder_ / "s1_model";
  }
};

// Oracle: FIPS 180-2 test vectors: "abc", the empty message and one million 'a'.
TEST_F(ManifestTest, Sha256MeetsTheStandardsVectors) {
  EXPECT_EQ(sha256(write("abc", "abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(write("empty", "")), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256(write("million", std::string(1000000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_THROW(static_cast<void>(sha256(folder_ / "none")), InputError);
}

// Oracle: reading is the inverse of writing, the largest seed included.
TEST_F(ManifestTest, RoundTrips) {
  const Manifest read = read_manifest(finished_step());
  EXPECT_EQ(read.step, "s1_model");
  EXPECT_EQ(read.status, "converged");
  EXPECT_EQ(read.message, "all well");
  EXPECT_EQ(read.config_toml, "a = 1\n");
  EXPECT_EQ(read.command_line, (std::vector<std::string>{"s1_model", "--quiet"}));
  EXPECT_EQ(read.seed, 18446744073709551615u);
  EXPECT_EQ(read.threads, 2);
  EXPECT_EQ(read.seconds, 1.5);
  EXPECT_EQ(read.inputs.at("data/bridge.toml"), "ab");
  EXPECT_EQ(read.outputs.size(), 2u);
}

// Oracle: untouched results pass; each way of tampering is refused with its reason.
TEST_F(ManifestTest, RefusesTamperedResults) {
  const auto step = finished_step();
  const auto check = [&](const std::filesystem::path& path) { return refusal([&] { check_against_manifest(path); }); };
  EXPECT_EQ(check(step), "");
  EXPECT_EQ(check(step / "modes.csv"), "");
  EXPECT_EQ(check(step / "model"), "");
  write("s1_model/modes.csv", "mode,frequency_Hz\n1,0.6\n");
  EXPECT_TRUE(check(step / "modes.csv").starts_with("s1_model/modes.csv: was changed after s1_model wrote it"));
  EXPECT_TRUE(check(step).starts_with("s1_model/modes.csv: was changed"));
  EXPECT_EQ(check(step / "model"), "");
  write("s1_model/model/masses.csv", "x\n");
  EXPECT_TRUE(check(step / "model").starts_with("s1_model/model/masses.csv: is not among the outputs"));
  std::filesystem::remove(step / "model" / "masses.csv");
  std::filesystem::remove(step / "model" / "nodes.csv");
  EXPECT_NE(check(step / "model").find("is gone, though the manifest of s1_model lists it"), std::string::npos);
}

// Oracle: a user's own data carry no manifest of ours, or somebody else's file of that name; both are accepted.
TEST_F(ManifestTest, AcceptsOwnData) {
  const auto own = write("own/modes.csv", "mode\n1\n");
  EXPECT_EQ(refusal([&] { check_against_manifest(own); }), "");
  write("own/manifest.json", "{\"name\": \"a web page\"}");
  EXPECT_EQ(refusal([&] { check_against_manifest(own); }), "");
  EXPECT_FALSE(is_step_folder(folder_ / "own"));
  EXPECT_NE(refusal([&] { static_cast<void>(read_manifest(folder_ / "own")); }).find("no readable manifest"),
            std::string::npos);
}

// Oracle: a manifest cut short vouches for nothing, so its folder is refused, not trusted.
TEST_F(ManifestTest, RefusesABrokenManifest) {
  const auto step = finished_step();
  write("s1_model/manifest.json", "{\"format\": \"twindeck-mani");
  EXPECT_NE(refusal([&] { check_against_manifest(step / "modes.csv"); }).find("is no readable JSON"), std::string::npos);
  EXPECT_FALSE(is_step_folder(step));
}

}  // namespace
}  // namespace twindeck::io
