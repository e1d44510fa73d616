#include "model/machine.h"

#include "base/instruction_set.h"
#include "geometry/every_target.h"
#include "model/cache_sizes.h"
#include "model/cpu_identity.h"
#include "model/cpu_quota.h"
#include "profile_fixture.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>

namespace raywise {
namespace {

TEST(MachineKey, IsAsDocumented) {
    Machine machine;
    machine.vendor = "AuthenticAMD";
    machine.family = 26;
    machine.model = 2;
    machine.stepping = 1;
    machine.instruction_set = "AVX3";
    machine.l3_bytes = 32u << 20;
    machine.threads = 2;
    EXPECT_EQ(machine.key(), "authenticamd-26-2-1-avx3-l3-32m-t2");
    machine.l3_bytes = 1280u << 10;
    EXPECT_EQ(machine.key(), "authenticamd-26-2-1-avx3-l3-1280k-t2");
}

TEST(MachineKey, IsAPlainFileNameWhateverTheProcessorSays) {
    Machine machine;
    for (const char* vendor : {"", " ", "../../etc/passwd", "Genuine  Intel", "\xC3\xA4\n/", "A:B"}) {
        machine.vendor = vendor;
        const std::string key = machine.key();
        EXPECT_EQ(key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"), std::string::npos) << key;
        EXPECT_NE(key.front(), '-') << key;
    }
    machine.vendor = "";
    EXPECT_EQ(machine.key().rfind("unknown-", 0), 0u);
}

TEST(ThisMachine, IsKnown) {
    const Machine& machine = this_machine();
    EXPECT_FALSE(machine.vendor.empty());
    EXPECT_GE(machine.threads, 1u);
    EXPECT_EQ(machine.precision, "float64");
    EXPECT_EQ(machine.brand.find('\0'), std::string::npos);
#if defined(__x86_64__)
    EXPECT_EQ(machine.vendor.size(), 12u);
    EXPECT_GT(machine.family, 0u);
#endif
    EXPECT_EQ(machine.instruction_set, instruction_set());
    EXPECT_EQ(&machine, &this_machine());
}

// What kernels use, machine and key tell; costs measured with one level are not taken for those of another.
TEST(ThisMachine, TellsTheInstructionSetInUse) {
    std::set<std::string> keys;
    std::size_t targets = 0;
    on_every_target([&] {
        ++targets;
        const std::string name = hwy::TargetName(hwy::SupportedAndGeneratedTargets().front());
        EXPECT_EQ(instruction_set(), name);
        const Machine machine = look_at_machine();
        EXPECT_EQ(machine.instruction_set, name);
        std::string lower;
        for (const char c : name) lower += c == '_' ? '-' : static_cast<char>(std::tolower(c));
        EXPECT_NE(machine.key().find("-" + lower + "-l3-"), std::string::npos) << machine.key();
        keys.insert(machine.key());

        Profile profile = sample_profile();
        profile.machine = machine;
        std::string reason;
        EXPECT_EQ(check_machine(profile, machine, reason), Status::OK);
        profile.machine.instruction_set = "OTHER";
        EXPECT_EQ(check_machine(profile, machine, reason), Status::PROFILE_MACHINE);
        EXPECT_EQ(reason, "machine.instruction_set: the profile has \"OTHER\", this machine \"" + name + "\"");
    });
    EXPECT_EQ(keys.size(), targets);
    EXPECT_EQ(instruction_set(), this_machine().instruction_set);
}

// A host program that turns a level off gets the key of the next one.
TEST(ThisMachine, FollowsTargetsThatAreDisabled) {
    const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
    if (targets.size() > 1) {
        hwy::DisableTargets(targets.front());
        EXPECT_EQ(look_at_machine().instruction_set, hwy::TargetName(targets[1]));
        hwy::DisableTargets(0);
    }
    EXPECT_EQ(look_at_machine().instruction_set, hwy::TargetName(targets.front()));
}

TEST(CpuIdentity, ReadsAnArmProcessor) {
    const CpuIdentity cpu = arm_identity(
        "processor\t: 0\nBogoMIPS\t: 243.75\nFeatures\t: fp asimd\nCPU implementer\t: 0x41\n"
        "CPU architecture: 8\nCPU variant\t: 0x3\nCPU part\t: 0xd0c\nCPU revision\t: 1\n\n"
        "processor\t: 1\nCPU part\t: 0xd05\n");
    EXPECT_EQ(cpu.vendor, "arm-0x41");
    EXPECT_EQ(cpu.family, 8u);
    EXPECT_EQ(cpu.model, 0xd0cu);
    EXPECT_EQ(cpu.stepping, 0x31u);
}

TEST(CpuIdentity, OfNothingIsUnknown) { EXPECT_EQ(arm_identity("").vendor, "unknown"); }

TEST(CacheSizes, AreReadFromTheSystemsDescription) {
    const TemporaryFolder folder;
    const auto describe = [&](const char* index, const char* level, const char* type, const char* size) {
        std::filesystem::create_directory(folder / index);
        folder.write(std::string(index) + "/level", std::string(level) + "\n");
        folder.write(std::string(index) + "/type", std::string(type) + "\n");
        folder.write(std::string(index) + "/size", std::string(size) + "\n");
    };
    describe("index0", "1", "Data", "48K");
    describe("index1", "1", "Instruction", "32K");
    describe("index2", "2", "Unified", "1024K");
    describe("index3", "3", "Unified", "32M");
    const CacheSizes sizes = cache_sizes(folder.path());
    EXPECT_EQ(sizes.l1, 48u << 10);
    EXPECT_EQ(sizes.l2, 1u << 20);
    EXPECT_EQ(sizes.l3, 32u << 20);
}

class CpuQuota : public testing::Test {
protected:
    std::optional<double> quota(const std::string& membership) const {
        return cpu_quota(folder_.write("membership", membership), folder_ / "mount");
    }
    void put(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((folder_ / ("mount/" + name)).parent_path());
        folder_.write("mount/" + name, text);
    }
    TemporaryFolder folder_;
};

TEST_F(CpuQuota, IsEmptyWithoutALimit) {
    EXPECT_EQ(quota(""), std::nullopt);
    EXPECT_EQ(quota("0::/a\n"), std::nullopt);
    put("a/cpu.max", "max 100000\n");
    EXPECT_EQ(quota("0::/a\n"), std::nullopt);
    put("cpu/cpu.cfs_quota_us", "-1\n");
    put("cpu/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(quota("1:cpu:/\n"), std::nullopt);
}

TEST_F(CpuQuota, IsTheSmallestOfTheGroupsAround) {
    put("a/b/cpu.max", "400000 100000\n");
    put("a/cpu.max", "150000 100000\n");
    put("cpu.max", "max 100000\n");
    EXPECT_EQ(quota("0::/a/b\n"), 1.5);
}

TEST_F(CpuQuota, IsFoundWhereTheContainerSeesItsOwnGroupAsTheRoot) {
    put("cpu.max", "200000 100000\n");
    EXPECT_EQ(quota("0::/docker/1234\n"), 2.0);
    EXPECT_EQ(quota("0::/../../1234\n"), 2.0);
}

TEST_F(CpuQuota, OfVersionOneIsRead) {
    put("cpu,cpuacct/job/cpu.cfs_quota_us", "50000\n");
    put("cpu,cpuacct/job/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(quota("4:memory:/job\n3:cpu,cpuacct:/job\n"), 0.5);
    EXPECT_EQ(quota("4:memory:/job\n3:cpuset:/job\n"), std::nullopt);
}

TEST_F(CpuQuota, IgnoresNonsense) {
    put("cpu.max", "100000 0\n");
    EXPECT_EQ(quota("0::/\n"), std::nullopt);
    put("cpu.max", "-5 100000\n");
    EXPECT_EQ(quota("0::/\n"), std::nullopt);
    put("cpu.max", "\n");
    EXPECT_EQ(quota("nonsense\n0::/\n:\n"), std::nullopt);
}

} // namespace
} // namespace raywise
