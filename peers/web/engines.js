// One engine each: `make(bodies)` gives `step()`, `heights()` of what moves, and `free()`. Everybody runs at its own default
// settings (substeps, iterations), at 1/60 s, without sleep.

const DT = 1 / 60;

export const ENGINES = {
  "tiny-physics": async (options) => {
    const { init, World } = await import("tiny-physics");
    await init(options?.ours);
    return (bodies) => {
      const world = new World({ gravity: [0, -9.8], settings: { sleep: false } });
      const ids = bodies.map((body) =>
        world.addBody({
          kind: body.density ? "dynamic" : "static",
          position: [body.x, body.y],
          angle: body.angle ?? 0,
          shapes: [{ shape: body.half ? { rect: { half_extents: body.half } } : { circle: { radius: body.radius } } }],
        }),
      );
      return {
        step: () => world.step(DT),
        heights: () => ids.filter((_, i) => bodies[i].density).map((id) => world.body(id).position.y),
        free: () => world.free(),
      };
    };
  },

  "box2d3-wasm": async () => {
    const { default: Box2DFactory } = await import("box2d3-wasm");
    const b2 = await Box2DFactory();
    return (bodies) => {
      const def = b2.b2DefaultWorldDef();
      def.gravity.Set(0, -9.8);
      def.enableSleep = false;
      const world = b2.b2CreateWorld(def);
      const ids = bodies.map((body) => {
        const bodyDef = b2.b2DefaultBodyDef();
        if (body.density) bodyDef.type = b2.b2BodyType.b2_dynamicBody;
        bodyDef.position.Set(body.x, body.y);
        bodyDef.rotation.SetAngle?.(body.angle ?? 0);
        const id = b2.b2CreateBody(world, bodyDef);
        const shape = b2.b2DefaultShapeDef();
        if (body.density) shape.density = body.density;
        if (body.half) {
          b2.b2CreatePolygonShape(id, shape, b2.b2MakeBox(body.half[0], body.half[1]));
        } else {
          const circle = new b2.b2Circle();
          circle.center.Set(0, 0);
          circle.radius = body.radius;
          b2.b2CreateCircleShape(id, shape, circle);
        }
        return id;
      });
      return {
        step: () => b2.b2World_Step(world, DT, 4),
        heights: () => ids.filter((_, i) => bodies[i].density).map((id) => b2.b2Body_GetPosition(id).y),
        free: () => b2.b2DestroyWorld(world),
      };
    };
  },

  "rapier2d-simd": async () => {
    const { default: RAPIER } = await import("@dimforge/rapier2d-simd-compat");
    await RAPIER.init();
    return (bodies) => {
      const world = new RAPIER.World({ x: 0, y: -9.8 });
      world.timestep = DT;
      const made = bodies.map((body) => {
        const def = body.density ? RAPIER.RigidBodyDesc.dynamic() : RAPIER.RigidBodyDesc.fixed();
        def.setTranslation(body.x, body.y).setRotation(body.angle ?? 0).setCanSleep(false);
        const rigid = world.createRigidBody(def);
        const shape = body.half ? RAPIER.ColliderDesc.cuboid(...body.half) : RAPIER.ColliderDesc.ball(body.radius);
        world.createCollider(shape.setDensity(body.density ?? 1), rigid);
        return rigid;
      });
      return {
        step: () => world.step(),
        heights: () => made.filter((_, i) => bodies[i].density).map((rigid) => rigid.translation().y),
        free: () => world.free(),
      };
    };
  },

  planck: async () => {
    const { Box, Circle, Vec2, World } = await import("planck");
    return (bodies) => {
      const world = new World({ gravity: new Vec2(0, -9.8), allowSleep: false });
      const made = bodies.map((body) => {
        const rigid = world.createBody({ type: body.density ? "dynamic" : "static", position: new Vec2(body.x, body.y), angle: body.angle ?? 0 });
        const shape = body.half ? new Box(...body.half) : new Circle(body.radius);
        rigid.createFixture({ shape, density: body.density ?? 0, friction: 0.6 });
        return rigid;
      });
      return {
        step: () => world.step(DT),
        heights: () => made.filter((_, i) => bodies[i].density).map((rigid) => rigid.getPosition().y),
        free: () => {},
      };
    };
  },

  "matter-js": async () => {
    const { default: Matter } = await import("matter-js");
    // It counts in pixels, y down; 40 to a metre, as its examples have it.
    const scale = 40;
    return (bodies) => {
      const engine = Matter.Engine.create({ enableSleeping: false });
      const made = bodies.map((body) => {
        const options = { isStatic: !body.density, angle: -(body.angle ?? 0), friction: 0.6 };
        const [x, y] = [body.x * scale, -body.y * scale];
        return body.half
          ? Matter.Bodies.rectangle(x, y, 2 * body.half[0] * scale, 2 * body.half[1] * scale, options)
          : Matter.Bodies.circle(x, y, body.radius * scale, options);
      });
      Matter.Composite.add(engine.world, made);
      return {
        step: () => Matter.Engine.update(engine, 1000 * DT),
        heights: () => made.filter((_, i) => bodies[i].density).map((rigid) => -rigid.position.y / scale),
        free: () => Matter.Engine.clear(engine),
      };
    };
  },
};
