#pragma once
// A Vulkan device without Vulkan types: choice, buffers, textures, pipelines, recorded work, timestamps, dispatch
// counts. Knows nothing about hair. Everything made by a Device keeps it alive. One Device is used from one thread at a
// time.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "core/result.h"
#include "core/trace.h"

namespace cuticle::gpu {

struct DeviceInfo {
  int index = 0;
  std::string name, driver, api_version;
  bool is_software = false;
  std::uint32_t subgroup_size = 0;
  bool subgroup_broadcast = false;  ///< compute shaders may broadcast and vote in a subgroup
  std::uint64_t max_storage_buffer_bytes = 0;
  std::uint64_t max_texel_buffer_bytes = 0;  ///< of a buffer that is read as texels of 16 bytes
  std::uint64_t heap_bytes = 0;
  std::uint32_t max_workgroup_invocations = 0;
  std::uint32_t max_image_size = 0;
  std::vector<int> sample_counts;  ///< multisampling offered for colour and depth
  bool timestamps = false;
  bool wide_lines = false;
  bool fragment_counts = false;  ///< Commands::begin_count
  std::string unusable;          ///< why Device::open refuses it; empty if it can be used
};

struct DeviceRequest {
  /// "" = the environment variable CUTICLE_DEVICE, else the first GPU, else software Vulkan; "cpu" = software; "gpu" =
  /// a real GPU or an error; a number = that index; anything else = the first device whose name contains it.
  std::string choice;
  /// On: a validation message becomes an error of the next submit. Default: the environment variable
  /// CUTICLE_VALIDATION=1.
  bool validation = false;
  /// Storage buffers hold no more, whatever the device allows; 0: as it does. For tests of what a smaller device needs.
  std::uint32_t most_storage_bytes = 0;
};

/// All Vulkan devices; empty when there is no loader or no driver.
std::vector<DeviceInfo> list_devices();

enum class TextureFormat { rgba8, rgba16f, rgba32f, r32f, r32u, rgba32u, depth32f };
enum class Filter { nearest, linear };
/// alpha: color = source * source alpha + target * (1 - source alpha), alpha likewise with factor 1; additive: the sum.
enum class BlendMode { none, alpha, additive };
enum class Topology { triangles, lines };
/// Which depths pass against that of the target.
enum class DepthCompare { less_or_equal, less, equal };

class Device;

/// Device memory, addressed as a storage buffer; or a part of it (part_of). Move-only; empty when default-constructed.
class Buffer {
 public:
  Buffer();
  ~Buffer();
  Buffer(Buffer&&) noexcept;
  Buffer& operator=(Buffer&&) noexcept;
  std::size_t size() const;
  explicit operator bool() const { return impl_ != nullptr; }
  struct Impl;
  Impl* impl() const { return impl_.get(); }

 private:
  friend class Device;
  friend Buffer part_of(const Buffer& buffer, std::size_t offset, std::size_t bytes);
  std::unique_ptr<Impl> impl_;
};

/// `bytes` of a buffer from `offset` on, a multiple of 256, which share its memory and keep it alive: how a shader
/// writes a buffer that is too large to be bound as a whole. A part that is not within the buffer is a broken promise.
Buffer part_of(const Buffer& buffer, std::size_t offset, std::size_t bytes);

/// A 2D image, sampled (clamped to the edge) and, if asked for, rendered to.
class Texture {
 public:
  Texture();
  ~Texture();
  Texture(Texture&&) noexcept;
  Texture& operator=(Texture&&) noexcept;
  glm::ivec2 size() const;
  TextureFormat format() const;
  int samples() const;
  explicit operator bool() const { return impl_ != nullptr; }
  struct Impl;
  Impl* impl() const { return impl_.get(); }

 private:
  friend class Device;
  std::unique_ptr<Impl> impl_;
};

struct TextureDescription {
  glm::ivec2 size{1};
  TextureFormat format = TextureFormat::rgba16f;
  Filter filter = Filter::linear;
  int samples = 1;
  bool render_target = false;
  bool read_samples = false;  ///< multisampled, and shaders read it sample by sample
  bool mip_levels = false;    ///< halved down to one texel, anew with every upload or copy; linear filter, no target
};

/// A buffer's binding that the shader reads as texels of a format, by samplerBuffer or usamplerBuffer and texelFetch,
/// within its end. Software Vulkan loads those of all lanes at once, of a storage buffer one by one.
struct TexelBinding {
  std::uint32_t binding = 0;
  TextureFormat format = TextureFormat::r32u;  ///< not rgba8 nor depth32f
};

/// Shader resources are set 0. Bindings 0 .. storage_buffers-1 are storage buffers, but for those of `texels`; the
/// textures follow at storage_buffers .. storage_buffers+textures-1 as combined image samplers.
struct ShaderInterface {
  std::uint32_t storage_buffers = 0;
  std::uint32_t textures = 0;
  std::uint32_t push_constant_bytes = 0;           ///< at most 128
  std::vector<std::uint32_t> specialization = {};  ///< values of constant_id 0, 1, 2, ...
  std::vector<TexelBinding> texels = {};           ///< of the buffers
};

/// A compute pipeline.
class Kernel {
 public:
  Kernel();
  ~Kernel();
  Kernel(Kernel&&) noexcept;
  Kernel& operator=(Kernel&&) noexcept;
  explicit operator bool() const { return impl_ != nullptr; }
  struct Impl;
  Impl* impl() const { return impl_.get(); }

 private:
  friend class Device;
  std::unique_ptr<Impl> impl_;
};

struct GraphicsDescription {
  std::span<const std::uint32_t> vertex_spirv, fragment_spirv;  ///< no fragment shader: only depth is drawn
  ShaderInterface interface;  ///< shared by both stages; vertices are pulled from storage buffers
  Topology topology = Topology::triangles;
  std::vector<TextureFormat> color_formats;
  BlendMode blend = BlendMode::none;
  bool depth_test = false, depth_write = false;  ///< depth clears to 1
  DepthCompare depth_compare = DepthCompare::less_or_equal;
  bool depth_target = false;  ///< rendered with a depth target though it does neither
  int samples = 1;
  float line_width = 1;  ///< used where the device has wide lines
  bool cull_back_faces = false, cull_front_faces = false;
};
/// A graphics pipeline (dynamic rendering; viewport follows the target).
class GraphicsPipeline {
 public:
  GraphicsPipeline();
  ~GraphicsPipeline();
  GraphicsPipeline(GraphicsPipeline&&) noexcept;
  GraphicsPipeline& operator=(GraphicsPipeline&&) noexcept;
  explicit operator bool() const { return impl_ != nullptr; }
  struct Impl;
  Impl* impl() const { return impl_.get(); }

 private:
  friend class Device;
  std::unique_ptr<Impl> impl_;
};

/// What one pass cost: timestamps (0 where the device has none), and how much was dispatched and drawn.
struct PassCost {
  std::string name;
  double gpu_ms = 0;
  std::uint32_t dispatches = 0;
  std::uint32_t draws = 0;
};

/// How often a fragment shader ran (pipeline statistics; Vulkan lets a device run it for more than the pixels drawn).
struct FragmentCount {
  std::string name;
  std::uint64_t invocations = 0;
};

/// Work recorded for one submission. A memory barrier stands between any two recorded operations, so each sees what the
/// one before wrote (one rendering, with all its draws, is one operation; clip space is Vulkan's: y down, depth 0..1).
/// Dispatches and draws count toward the outermost open pass. What was recorded stays alive until the work is done.
/// A misuse (an empty buffer, a count that does not fit the shader) is kept and becomes the error of submit.
class Commands {
 public:
  Commands(Commands&&) noexcept;
  ~Commands();
  void begin_pass(std::string_view name);
  void end_pass();
  void dispatch(const Kernel& kernel, std::initializer_list<const Buffer*> buffers,
                std::initializer_list<const Texture*> textures, std::span<const std::byte> push_constants,
                std::uint32_t groups_x, std::uint32_t groups_y = 1, std::uint32_t groups_z = 1);
  /// The same for lists made at run time.
  void dispatch(const Kernel& kernel, std::span<const Buffer* const> buffers, std::span<const Texture* const> textures,
                std::span<const std::byte> push_constants, std::uint32_t groups_x, std::uint32_t groups_y = 1,
                std::uint32_t groups_z = 1);
  /// The same with numbers that the device wrote: workgroups on the three axes, 32 bits each, from `offset` on (every
  /// kernel can hold as many as it writes; the CPU does not know them).
  void dispatch_counted(const Kernel& kernel, std::span<const Buffer* const> buffers,
                        std::span<const Texture* const> textures, std::span<const std::byte> push_constants,
                        const Buffer& numbers, std::size_t offset = 0);
  /// Every 32-bit word of the buffer := value.
  void fill(const Buffer& buffer, std::uint32_t value);
  void copy(const Buffer& from, const Buffer& to, std::size_t bytes, std::size_t from_offset = 0,
            std::size_t to_offset = 0);
  /// Texels of the texture's own format, in tightly packed rows, from a buffer; the offset a multiple of a texel.
  void copy(const Buffer& from, const Texture& to, std::size_t from_offset = 0);
  /// Bytes kept with the commands until they run: at most 65,536, a multiple of 4, as is the offset.
  void write(const Buffer& to, std::span<const std::byte> data, std::size_t offset = 0);
  /// Rendering to these targets until end_rendering. A multisampled color target resolves into `resolve` (may be null).
  struct Target {
    const Texture* color = nullptr;
    const Texture* resolve = nullptr;
    glm::vec4 clear{0};
    bool keep = false;  ///< load what is there instead of clearing
  };
  void begin_rendering(std::span<const Target> color, const Texture* depth, bool keep_depth = false);
  void draw(const GraphicsPipeline& pipeline, std::initializer_list<const Buffer*> buffers,
            std::initializer_list<const Texture*> textures, std::span<const std::byte> push_constants,
            std::uint32_t vertices, std::uint32_t instances = 1);
  /// The same with numbers that the device wrote: vertices, instances, first vertex and first instance, 32 bits each
  /// (every buffer holds as much).
  void draw_counted(const GraphicsPipeline& pipeline, std::initializer_list<const Buffer*> buffers,
                    std::initializer_list<const Texture*> textures, std::span<const std::byte> push_constants,
                    const Buffer& numbers);
  void end_rendering();
  /// Counts fragments of the renderings until end_count, into SubmitCost::fragments; nothing where the device cannot.
  void begin_count(std::string_view name);
  void end_count();
  struct Impl;
  Impl* impl() const { return impl_.get(); }

 private:
  friend class Device;
  explicit Commands(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// What a submission did, pass by pass, with its wall time (submit to finish, milliseconds).
struct SubmitCost {
  double wall_ms = 0;
  std::vector<PassCost> passes;
  std::vector<FragmentCount> fragments;
};

/// Work that was started and may still run; what it uses stays alive. Move-only; waits when it is destroyed.
class Running {
 public:
  Running(Running&&) noexcept;
  Running& operator=(Running&&) noexcept;
  ~Running();
  /// Whether the work has ended; does not wait.
  bool is_done() const;
  /// Waits, then says what the work cost; wall_ms runs until this call. Once only. Errors: as Device::submit.
  Result<SubmitCost> finish();
  struct Impl;

 private:
  friend class Device;
  explicit Running(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

class Device : public std::enable_shared_from_this<Device> {
 public:
  /// Error: no_device, saying what was found and what to install or choose.
  static Result<std::shared_ptr<Device>> open(const DeviceRequest& request = {});
  ~Device();
  const DeviceInfo& info() const;

  /// Error: out_of_memory, naming size and limit (a single buffer is at most info().max_storage_buffer_bytes).
  Result<Buffer> make_buffer(std::size_t bytes);
  /// A buffer that shaders read as texels and write in parts: at most info().max_texel_buffer_bytes of 16 bytes each,
  /// and as many of a smaller format.
  Result<Buffer> make_texel_buffer(std::size_t bytes, TextureFormat format = TextureFormat::rgba32f);
  Result<void> upload(const Buffer& buffer, std::span<const std::byte> data, std::size_t offset = 0);
  Result<void> download(const Buffer& buffer, std::span<std::byte> data, std::size_t offset = 0);

  Result<Texture> make_texture(const TextureDescription& description);
  /// `data`: tightly packed rows of the texture's format (rgba16f and rgba32f take floats and are converted).
  Result<void> upload(const Texture& texture, std::span<const float> data);
  /// Floats, four per texel (one for r32f, r32u and depth32f).
  Result<std::vector<float>> download(const Texture& texture);

  /// Shader and interface that were made before cost nothing: the device keeps its last 512 pipelines, and those in use.
  Result<Kernel> make_kernel(std::span<const std::uint32_t> spirv, const ShaderInterface& interface);
  Result<GraphicsPipeline> make_graphics(const GraphicsDescription& description);
  /// How many pipelines were made since the device was opened, those of kernels included.
  std::size_t pipelines_made() const;

  Commands record();
  /// Runs the work and waits. Error: internal on a validation message, no_device when the device was lost.
  Result<SubmitCost> submit(Commands commands, Trace* trace = nullptr);
  /// Starts the work and returns at once. What is submitted later runs after it. Error: as submit, but for what only
  /// the end of the work shows.
  Result<Running> start(Commands commands);

  /// Bytes of buffers and textures alive now, and the most there have been.
  std::size_t allocated_bytes() const;
  std::size_t peak_allocated_bytes() const;

  struct Impl;
  Impl* impl() const { return impl_.get(); }

 private:
  Device();
  Result<Buffer> make_up_to(std::size_t bytes, std::uint64_t most);
  std::unique_ptr<Impl> impl_;
};

/// Bytes of a plain struct, for push constants and uploads.
template <class T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span<const T, 1>(&value, 1));
}

/// A buffer holding a copy of the data.
template <class T>
Result<Buffer> make_buffer_from(Device& device, std::span<const T> data) {
  CUTICLE_ASSIGN(Buffer buffer, device.make_buffer(data.size_bytes()));
  CUTICLE_TRY(device.upload(buffer, std::as_bytes(data)));
  return buffer;
}
template <class T>
Result<std::vector<T>> read_buffer(Device& device, const Buffer& buffer, std::size_t count) {
  std::vector<T> data(count);
  CUTICLE_TRY(device.download(buffer, std::as_writable_bytes(std::span<T>(data))));
  return data;
}

/// Work split so that no part passes a limit: consecutive [begin, end) ranges of at most limit_bytes / bytes_each
/// items.
struct Chunk {
  std::size_t begin = 0, end = 0;
};
std::vector<Chunk> chunks(std::size_t items, std::size_t bytes_each, std::uint64_t limit_bytes);

}  // namespace cuticle::gpu
