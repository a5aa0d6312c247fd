//! A program on wgpu, which draws a triangle of its own, and a ball of splats by the lines of `docs/wgpu.md`: `third_party/hosts` puts them in the places of the two
//! lines in capitals, compiles this with that release of wgpu, and runs it under validation. Each hides the other where it is nearer.

use surfel::{
    Scene, Settings,
    ash::vk,
    embed::{
        Device, Features, HostCamera, HostImage, Import, Placed, Renderer, Rendering, View, ViewFrame,
    },
    glam::{DMat4, DVec3, Vec3},
    scene::{Colors, Object, Shapes, Splats},
};

const SIZE: u32 = 256;
const FRAMES: usize = 3;

const SHADERS: &str = "
@vertex fn vs(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    var corners = array(vec4(-0.9, -0.5, 0.02, 1.0), vec4(0.9, -0.5, 0.06, 1.0), vec4(0.0, 0.9, 0.04, 1.0));
    return corners[i];
}
@fragment fn fs() -> @location(0) vec4<f32> {
    return vec4(0.0, 0.0, 1.0, 1.0);
}";

/// A red ball.
fn ball() -> Scene {
    const COUNT: usize = 5000;
    const RADIUS: f32 = 0.7;
    let normal = |i: usize| {
        let z = 1.0 - (2 * i + 1) as f32 / COUNT as f32;
        let (angle, ring) = (2.399_963 * i as f32, (1.0 - z * z).sqrt());
        Vec3::new(ring * angle.cos(), ring * angle.sin(), z)
    };
    let normals: Vec<Vec3> = (0..COUNT).map(normal).collect();
    let centers: Vec<DVec3> = normals.iter().map(|normal| (RADIUS * *normal).as_dvec3()).collect();
    let radii = vec![1.4 * RADIUS * (4.0 / COUNT as f32).sqrt(); COUNT];
    let splats =
        Splats::new(centers, Shapes::Disks { normals, radii }, Colors::Uniform([0.9, 0.2, 0.1, 1.0]));
    Scene::from(Object { name: "ball".to_owned(), splats, closed: true })
}

fn main() {
    let instance = wgpu::Instance::new(&wgpu::InstanceDescriptor {
        backends: wgpu::Backends::VULKAN,
        flags: wgpu::InstanceFlags::VALIDATION,
        ..Default::default()
    });
    let adapter = pollster::block_on(instance.request_adapter(&Default::default())).unwrap();

    // ONCE

    let texture = |format, usage| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        })
    };
    let color = texture(wgpu::TextureFormat::Rgba8UnormSrgb, wgpu::TextureUsages::COPY_SRC);
    let depth = texture(wgpu::TextureFormat::Depth32Float, wgpu::TextureUsages::empty());
    let views = [&color, &depth].map(|texture| texture.create_view(&Default::default()));
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(SHADERS.into()),
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: None,
            buffers: &[],
            compilation_options: Default::default(),
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: true,
            depth_compare: wgpu::CompareFunction::Greater,
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: None,
            targets: &[Some(wgpu::TextureFormat::Rgba8UnormSrgb.into())],
            compilation_options: Default::default(),
        }),
        multiview: None,
        cache: None,
    });
    // Reversed, infinite, y up.
    let focal = 0.4_f64.tan().recip();
    let mut clip_from_view = DMat4::from_diagonal([focal, focal, 0.0, 0.0].into());
    (clip_from_view.z_axis.w, clip_from_view.w_axis.z) = (-1.0, 0.1);
    let view_from_world = DMat4::from_translation(DVec3::new(0.0, 0.0, -2.5));
    let camera = HostCamera { view_from_world, clip_from_view, flips_y: true };
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(4 * SIZE * SIZE),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    for _ in 0..FRAMES {
        let pass = |encoder: &mut wgpu::CommandEncoder, drawn: Option<&wgpu::RenderPipeline>| {
            let (color, depth) = match drawn {
                Some(_) => (wgpu::LoadOp::Clear(wgpu::Color::WHITE), wgpu::LoadOp::Clear(0.0)),
                None => (wgpu::LoadOp::Load, wgpu::LoadOp::Load),
            };
            let store = wgpu::StoreOp::Store;
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: None,
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &views[0],
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load: color, store },
                })],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &views[1],
                    depth_ops: Some(wgpu::Operations { load: depth, store }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            if let Some(pipeline) = drawn {
                pass.set_pipeline(pipeline);
                pass.draw(0..3, 0..1);
            }
        };
        let mut encoder = device.create_command_encoder(&Default::default());
        pass(&mut encoder, Some(&pipeline));
        let before = encoder.finish();
        let mut encoder = device.create_command_encoder(&Default::default());
        pass(&mut encoder, None);
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * SIZE),
            rows_per_image: None,
        };
        let target = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
        encoder.copy_texture_to_buffer(color.as_image_copy(), target, color.size());
        let after = encoder.finish();

        // EACH FRAME

        device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    }
    buffer.slice(..).map_async(wgpu::MapMode::Read, |answer| answer.unwrap());
    device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
    let pixels = buffer.slice(..).get_mapped_range().to_vec();
    let count = |is: fn(&[u8]) -> bool| pixels.chunks(4).filter(|pixel| is(pixel)).count();
    let red = count(|pixel| pixel[0] > 100 && pixel[2] < 100);
    let (blue, white) = (count(|pixel| pixel[2] > 200 && pixel[0] < 50), count(|pixel| pixel[..3] == [255; 3]));
    println!("{red} pixels of the ball, {blue} of the triangle, {white} of nothing");
    assert!(red > 2000 && blue > 2000 && white > 2000);
    drop((view, scene, renderer));
    let epoch = ours.end_epoch();
    // SAFETY: all was waited for.
    unsafe { ours.epoch_done(epoch) };
    drop(ours);
}
