#include "shader_cost/cost.hpp"

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>

#include <vulkan/vulkan.h>

#include "common/file.hpp"
#include "common/report_text.hpp"

namespace examples {
namespace {

void require(VkResult result, const char* call) {
    if (result != VK_SUCCESS) throw failure(format("%s failed (%d)", call, int(result)));
}

constexpr std::uint32_t textures = 7;
constexpr std::uint32_t push_constant_bytes = 128;

}  // namespace

struct compiler::state {
    VkInstance instance = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkDescriptorSetLayout set = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    PFN_vkGetPipelineExecutableStatisticsKHR statistics = nullptr;

    ~state() {
        if (device != VK_NULL_HANDLE) {
            vkDestroyPipelineLayout(device, layout, nullptr);
            vkDestroyDescriptorSetLayout(device, set, nullptr);
            vkDestroyDevice(device, nullptr);
        }
        if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
    }

    void open(const family& target, const std::string& icd) {
        VkApplicationInfo application{};
        application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
        application.apiVersion = VK_API_VERSION_1_2;
        VkInstanceCreateInfo instance_info{};
        instance_info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        instance_info.pApplicationInfo = &application;
        if (const VkResult made = vkCreateInstance(&instance_info, nullptr, &instance); made != VK_SUCCESS)
            throw failure(format("no Vulkan driver loads from %s (%d)", icd.c_str(), int(made)));
        std::uint32_t count = 1;
        VkPhysicalDevice physical = VK_NULL_HANDLE;
        const VkResult found = vkEnumeratePhysicalDevices(instance, &count, &physical);
        if ((found != VK_SUCCESS && found != VK_INCOMPLETE) || count == 0)
            throw failure("RADV makes no device for RADV_FORCE_FAMILY=" + target.name);
        VkPhysicalDeviceProperties about{};
        vkGetPhysicalDeviceProperties(physical, &about);
        constexpr std::uint32_t amd = 0x1002;
        if (about.vendorID != amd) throw failure("the Vulkan driver of " + icd + " is not RADV: " + about.deviceName);

        const float priority = 1.0f;
        VkDeviceQueueCreateInfo queue{};
        queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR properties{};
        properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR;
        properties.pipelineExecutableInfo = VK_TRUE;
        const char* const extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
        VkDeviceCreateInfo device_info{};
        device_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        device_info.pNext = &properties;
        device_info.queueCreateInfoCount = 1;
        device_info.pQueueCreateInfos = &queue;
        device_info.enabledExtensionCount = 1;
        device_info.ppEnabledExtensionNames = &extension;
        require(vkCreateDevice(physical, &device_info, nullptr, &device), "vkCreateDevice");
        statistics = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
            vkGetDeviceProcAddr(device, "vkGetPipelineExecutableStatisticsKHR"));
        if (statistics == nullptr) throw failure(std::string("the driver lacks ") + extension);
        make_layout();
    }

    void make_layout() {
        std::array<VkDescriptorSetLayoutBinding, textures + 1> bindings{};
        for (std::uint32_t i = 0; i < bindings.size(); ++i) {
            bindings[i].binding = i;
            bindings[i].descriptorType =
                i < textures ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            bindings[i].descriptorCount = 1;
            bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
        }
        VkDescriptorSetLayoutCreateInfo set_info{};
        set_info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
        set_info.bindingCount = textures + 1;
        set_info.pBindings = bindings.data();
        require(vkCreateDescriptorSetLayout(device, &set_info, nullptr, &set), "vkCreateDescriptorSetLayout");
        const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_constant_bytes};
        VkPipelineLayoutCreateInfo layout_info{};
        layout_info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
        layout_info.setLayoutCount = 1;
        layout_info.pSetLayouts = &set;
        layout_info.pushConstantRangeCount = 1;
        layout_info.pPushConstantRanges = &push;
        require(vkCreatePipelineLayout(device, &layout_info, nullptr, &layout), "vkCreatePipelineLayout");
    }

    [[nodiscard]] cost read(VkPipeline pipeline) const {
        VkPipelineExecutableInfoKHR which{};
        which.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR;
        which.pipeline = pipeline;
        std::uint32_t count = 0;
        require(statistics(device, &which, &count, nullptr), "vkGetPipelineExecutableStatisticsKHR");
        std::vector<VkPipelineExecutableStatisticKHR> all(count);
        for (auto& one : all) one.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR;
        require(statistics(device, &which, &count, all.data()), "vkGetPipelineExecutableStatisticsKHR");
        const auto value = [&](std::string_view name) {
            for (const auto& one : all)
                if (name == one.name) return int(one.value.u64);
            throw failure("the driver reports no statistic named " + std::string(name));
        };
        return {.instructions = value("Instructions"),
                .inverse_throughput = value("Inverse Throughput"),
                .latency = value("Latency"),
                .vgprs = value("VGPRs"),
                .sgprs = value("SGPRs")};
    }
};

compiler::compiler(const family& target, const std::string& icd) : state_(std::make_unique<state>()) {
    if (!std::filesystem::exists(icd)) throw failure("there is no Vulkan driver manifest " + icd);
    // Read by the loader and the driver when an instance is made.
    setenv("VK_ICD_FILENAMES", icd.c_str(), 1);
    setenv("VK_DRIVER_FILES", icd.c_str(), 1);
    setenv("RADV_FORCE_FAMILY", target.name.c_str(), 1);
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    state_->open(target, icd);
}

compiler::~compiler() = default;

cost compiler::measure(std::span<const std::uint32_t> spirv) const {
    const VkDevice device = state_->device;
    VkShaderModuleCreateInfo module_info{};
    module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    module_info.codeSize = spirv.size_bytes();
    module_info.pCode = spirv.data();
    VkShaderModule code = VK_NULL_HANDLE;
    require(vkCreateShaderModule(device, &module_info, nullptr, &code), "vkCreateShaderModule");
    VkComputePipelineCreateInfo pipeline_info{};
    pipeline_info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    pipeline_info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    pipeline_info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    pipeline_info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    pipeline_info.stage.module = code;
    pipeline_info.stage.pName = "main";
    pipeline_info.layout = state_->layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    const VkResult made = vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &pipeline_info, nullptr, &pipeline);
    vkDestroyShaderModule(device, code, nullptr);
    require(made, "vkCreateComputePipelines");
    const cost result = state_->read(pipeline);
    vkDestroyPipeline(device, pipeline, nullptr);
    return result;
}

std::string find_icd() {
    for (const char* folder : {"/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d"}) {
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with("radeon_icd") && name.ends_with(".json")) return entry.path().string();
        }
    }
    throw failure(
        "the RADV driver is not installed (Debian, Ubuntu: mesa-vulkan-drivers), or --icd has to name its manifest");
}

}  // namespace examples
