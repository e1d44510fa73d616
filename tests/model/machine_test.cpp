#include "model/machine.h"

#include "model/cache_sizes.h"
#include "model/cpu_identity.h"
#include "model/cpu_quota.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

namespace raywise {
namespace {

TEST(MachineKey, IsAsDocumented) {
    Machine machine;
    machine.vendor = "AuthenticAMD";
    machine.family = 26;
    machine.model = 2;
    machine.stepping = 1;
    machine.instruction_set = "x86-64";
    machine.l3_bytes = 32u << 20;
    machine.threads = 2;
    EXPECT_EQ(machine.key(), "authenticamd-26-2-1-x86-64-l3-32m-t2");
    machine.l3_bytes = 1280u << 10;
    EXPECT_EQ(machine.key(), "authenticamd-26-2-1-x86-64-l3-1280k-t2");
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
    EXPECT_EQ(machine.instruction_set, "x86-64");
    EXPECT_EQ(machine.vendor.size(), 12u);
    EXPECT_GT(machine.family, 0u);
#endif
    EXPECT_EQ(&machine, &this_machine());
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
    EXPECT_EQ(cpu.instruction_set, "aarch64");
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
