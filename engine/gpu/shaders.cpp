#include "gpu/shaders.h"

#include "base/check.h"
#include "base/error.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <fmt/core.h>

namespace antumbra::gpu {

namespace {

/// glslang's tables, made once a process and released with it.
struct GlslangProcess
{
    GlslangProcess() { glslang::InitializeProcess(); }
    ~GlslangProcess() { glslang::FinalizeProcess(); }
};

class ShaderIncluder final : public glslang::TShader::Includer
{
public:
    IncludeResult* includeLocal(const char* header, const char*, size_t) override
    {
        try {
            auto* text = new std::string(readText(projectPath("shaders") / header));
            return new IncludeResult(header, text->data(), text->size(), text);
        } catch (const Error&) {
            return nullptr; // glslang reports the line of the include
        }
    }
    IncludeResult* includeSystem(const char*, const char*, size_t) override { return nullptr; }
    void releaseInclude(IncludeResult* result) override
    {
        if (result == nullptr)
            return;
        delete static_cast<std::string*>(result->userData);
        delete result;
    }
};

EShLanguage stageOf(std::string_view file)
{
    const std::string_view extension = file.substr(file.rfind('.') + 1);
    if (extension == "comp")
        return EShLangCompute;
    if (extension == "vert")
        return EShLangVertex;
    check(extension == "frag", "a shader file that ends in .comp, .vert or .frag");
    return EShLangFragment;
}

std::string firstError(const char* log)
{
    const std::string_view text(log);
    const size_t begin = std::min(text.find("ERROR"), text.size());
    return std::string(text.substr(begin, text.find('\n', begin) - begin));
}

} // namespace

std::vector<uint32_t> compileShader(std::string_view file, std::span<const ShaderDefine> defines)
{
    static const GlslangProcess process;
    const Path path = projectPath("shaders") / file;
    const std::string source = readText(path);
    const std::string name(file);
    std::string preamble;
    for (const ShaderDefine& define : defines)
        preamble += define.text.empty() ? fmt::format("#define {} {}\n", define.name, define.value)
                                        : fmt::format("#define {} {}\n", define.name, define.text);

    const EShLanguage stage = stageOf(file);
    glslang::TShader shader(stage);
    const char* text = source.c_str();
    const char* label = name.c_str();
    const int length = static_cast<int>(source.size());
    shader.setStringsWithLengthsAndNames(&text, &length, &label, 1);
    shader.setPreamble(preamble.c_str());
    shader.setEnvInput(glslang::EShSourceGlsl, stage, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
    constexpr auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    ShaderIncluder includer;
    if (!shader.parse(GetDefaultResources(), 460, false, messages, includer))
        throw Error(firstError(shader.getInfoLog()), path.string());

    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages))
        throw Error(firstError(program.getInfoLog()), path.string());
    std::vector<uint32_t> words;
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(stage), words, &options);
    return words;
}

} // namespace antumbra::gpu
