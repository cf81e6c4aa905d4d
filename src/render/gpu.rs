//! The graphics device, or a sentence that says why there is none.

use thiserror::Error;
use wgpu::util::DeviceExt;

/// Format of the frame: X, Y, Z, V.
pub const FRAME_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Why there is no picture.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum GpuError {
    #[error(
        "no graphics adapter found; install a Vulkan driver (on Debian: apt-get install mesa-vulkan-drivers libvulkan1)"
    )]
    NoAdapter,
    #[error(
        "the graphics adapter {0} cannot add and blend light in 32-bit floats; use another adapter, or the software driver (on Debian: apt-get install mesa-vulkan-drivers)"
    )]
    NoFloatBlending(String),
    #[error("the graphics adapter {adapter} gave no device: {reason}")]
    NoDevice { adapter: String, reason: String },
    #[error(
        "a picture of {width_px}x{height_px} pixels is larger than the {limit} that this graphics adapter can draw; ask for a smaller --size"
    )]
    TooLarge { width_px: u32, height_px: u32, limit: u32 },
    #[error("the graphics device stopped while drawing: {0}")]
    Lost(String),
}

/// Time that the GPU spent on a pass.
#[derive(Debug, Clone, PartialEq)]
pub struct PassTime {
    pub pass: String,
    pub milliseconds: f64,
}

/// What a shader binds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binding {
    Uniform,
    /// Read only.
    Storage,
    /// Two-dimensional, read with a [`Binding::Sampler`].
    Texture,
    /// Straight between texels.
    Sampler,
}

impl Binding {
    fn kind(self) -> wgpu::BindingType {
        let buffer = |ty| wgpu::BindingType::Buffer {
            ty,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        match self {
            Binding::Uniform => buffer(wgpu::BufferBindingType::Uniform),
            Binding::Storage => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
            Binding::Texture => wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: true },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            Binding::Sampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        }
    }
}

/// Light is added to light.
const ADD: wgpu::BlendState = {
    let add = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    wgpu::BlendState { color: add, alpha: add }
};

/// A step from pictures to pictures: over all pixels, or, with vertex buffers, in quads.
#[derive(Clone)]
pub struct Stage<'a> {
    pub label: &'a str,
    pub source: String,
    /// Of vertices and of fragments.
    pub entries: [&'a str; 2],
    /// Values of what the shader leaves open.
    pub constants: &'a [(&'a str, f64)],
    pub targets: &'a [wgpu::TextureFormat],
    pub buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    /// Whether it adds to what is there.
    pub adds: bool,
}

/// The device and its queue.
pub struct Gpu {
    pub instance: wgpu::Instance,
    pub adapter: wgpu::Adapter,
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
    keeps_time: bool,
}

impl Gpu {
    /// The best adapter there is; a software one is as good as any other.
    pub fn new() -> Result<Gpu, GpuError> {
        let backends = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends,
            ..wgpu::InstanceDescriptor::new_without_display_handle_from_env()
        });
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))
            .map_err(|_| GpuError::NoAdapter)?;
        let info = adapter.get_info();
        let offered = adapter.features();
        let needed = wgpu::Features::FLOAT32_BLENDABLE | wgpu::Features::FLOAT32_FILTERABLE;
        if !offered.contains(needed) {
            return Err(GpuError::NoFloatBlending(info.name));
        }
        let timing = wgpu::Features::TIMESTAMP_QUERY;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("nocturne"),
            required_features: needed | (offered & timing),
            required_limits: adapter.limits(),
            ..Default::default()
        }))
        .map_err(|error| GpuError::NoDevice {
            adapter: info.name.clone(),
            reason: error.to_string(),
        })?;
        let keeps_time = offered.contains(timing);
        Ok(Gpu { instance, adapter, device, queue, info, keeps_time })
    }

    /// Name, driver and interface of the adapter.
    pub fn describe(&self) -> String {
        let wgpu::AdapterInfo { name, driver, driver_info, backend, .. } = &self.info;
        format!("{name} ({driver} {driver_info}, {backend})")
    }

    /// Whether passes can be timed.
    pub fn keeps_time(&self) -> bool {
        self.keeps_time
    }

    /// A buffer that holds `contents` from the start.
    pub fn buffer(&self, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let descriptor = wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage };
        self.device.create_buffer_init(&descriptor)
    }

    /// Buffers at their bindings.
    pub fn bind(
        &self,
        layout: &wgpu::BindGroupLayout,
        buffers: &[(u32, &wgpu::Buffer)],
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = buffers
            .iter()
            .map(|&(binding, buffer)| wgpu::BindGroupEntry {
                binding,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }

    /// The same for buffers, textures and samplers alike.
    pub fn bind_mixed(
        &self,
        layout: &wgpu::BindGroupLayout,
        resources: &[(u32, wgpu::BindingResource)],
    ) -> wgpu::BindGroup {
        let entries: Vec<_> = resources
            .iter()
            .map(|(binding, resource)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: resource.clone(),
            })
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout,
            entries: &entries,
        })
    }

    /// Reads straight between texels; what lies beyond the left and right edge as said, beyond the others
    /// the edge.
    pub fn linear_sampler(&self, beyond: wgpu::AddressMode) -> wgpu::Sampler {
        self.device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: beyond,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        })
    }

    /// Reads the nearest texel.
    pub fn nearest_sampler(&self) -> wgpu::Sampler {
        self.device.create_sampler(&wgpu::SamplerDescriptor::default())
    }

    pub fn texture(
        &self,
        label: &str,
        size: wgpu::Extent3d,
        format: wgpu::TextureFormat,
        usage: wgpu::TextureUsages,
    ) -> wgpu::Texture {
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    }

    /// A texture that shaders read, with its texels row by row.
    pub fn texture_of(
        &self,
        label: &str,
        size: wgpu::Extent3d,
        format: wgpu::TextureFormat,
        texels: &[u8],
    ) -> wgpu::Texture {
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
        let texture = self.texture(label, size, format, usage);
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(texels.len() as u32 / size.height),
            rows_per_image: None,
        };
        self.queue.write_texture(texture.as_image_copy(), texels, layout, size);
        texture
    }

    /// A pipeline that computes, by the name of its entry.
    pub fn compute_pipeline(&self, entry: &str, source: &str) -> wgpu::ComputePipeline {
        self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: None,
            module: &self.module(entry, source),
            entry_point: Some(entry),
            compilation_options: Default::default(),
            cache: None,
        })
    }

    pub fn module(&self, label: &str, source: &str) -> wgpu::ShaderModule {
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        })
    }

    /// A pipeline that adds its light to the frame; its entries are those of vertices and fragments.
    pub fn pipeline(
        &self,
        label: &str,
        source: &str,
        entries: [&str; 2],
        topology: wgpu::PrimitiveTopology,
        buffers: &[Option<wgpu::VertexBufferLayout>],
    ) -> wgpu::RenderPipeline {
        let module = self.module(label, source);
        self.any_pipeline(label, &module, entries, topology, buffers, Some(ADD))
    }

    /// A pipeline that writes its light over what the frame held; its entries are those of a stage,
    /// `stage_vertex` and `stage_fragment`.
    pub fn writing_pipeline(
        &self,
        label: &str,
        stage: &str,
        source: &str,
        topology: wgpu::PrimitiveTopology,
        buffers: &[Option<wgpu::VertexBufferLayout>],
    ) -> wgpu::RenderPipeline {
        let (vertex, fragment) = (format!("{stage}_vertex"), format!("{stage}_fragment"));
        let module = self.module(label, source);
        self.any_pipeline(label, &module, [&vertex, &fragment], topology, buffers, None)
    }

    /// A layout of bindings that several pipelines share, for vertices and fragments.
    pub fn layout(&self, bindings: &[Binding]) -> wgpu::BindGroupLayout {
        let entry = |(number, binding): (usize, &Binding)| wgpu::BindGroupLayoutEntry {
            binding: number as u32,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: binding.kind(),
            count: None,
        };
        self.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &bindings.iter().enumerate().map(entry).collect::<Vec<_>>(),
        })
    }

    /// A pipeline that draws triangles on a picture of its own, the last in front, with values for the
    /// constants that its shader leaves open.
    pub fn picture_pipeline(
        &self,
        label: &str,
        source: &str,
        bindings: &wgpu::BindGroupLayout,
        constants: &[(&str, f64)],
        format: wgpu::TextureFormat,
    ) -> wgpu::RenderPipeline {
        let module = self.module(label, source);
        let layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &[Some(bindings)],
            ..Default::default()
        });
        let compilation_options =
            wgpu::PipelineCompilationOptions { constants, ..Default::default() };
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: compilation_options.clone(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options,
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// A pipeline over whole pictures, or of points on them.
    pub fn chain_pipeline(&self, stage: &Stage) -> wgpu::RenderPipeline {
        let module = self.module(stage.label, &stage.source);
        let compilation_options =
            wgpu::PipelineCompilationOptions { constants: stage.constants, ..Default::default() };
        let topology = match stage.buffers {
            [] => wgpu::PrimitiveTopology::TriangleList,
            _ => wgpu::PrimitiveTopology::TriangleStrip,
        };
        let targets: Vec<_> = stage
            .targets
            .iter()
            .map(|&format| {
                let blend = stage.adds.then_some(ADD);
                let write_mask = wgpu::ColorWrites::ALL;
                Some(wgpu::ColorTargetState { format, blend, write_mask })
            })
            .collect();
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(stage.label),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(stage.entries[0]),
                compilation_options: compilation_options.clone(),
                buffers: stage.buffers,
            },
            primitive: wgpu::PrimitiveState { topology, ..Default::default() },
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(stage.entries[1]),
                compilation_options,
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    fn any_pipeline(
        &self,
        label: &str,
        module: &wgpu::ShaderModule,
        [vertex, fragment]: [&str; 2],
        topology: wgpu::PrimitiveTopology,
        buffers: &[Option<wgpu::VertexBufferLayout>],
        blend: Option<wgpu::BlendState>,
    ) -> wgpu::RenderPipeline {
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(label),
            layout: None,
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: Default::default(),
                buffers,
            },
            primitive: wgpu::PrimitiveState { topology, ..Default::default() },
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(fragment),
                compilation_options: Default::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: FRAME_FORMAT,
                    blend,
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}
