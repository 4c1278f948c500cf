package Heater "A block on a heating plate, in a room"
  package Slots "What may be missing, and where"
    partial model PartialActuator "Between the power wanted and the power that heats"
      input Real u(unit="W") "Power wanted";
      output Real y(unit="W") "Power that heats";
    end PartialActuator;

    partial model PartialLoss "A heat flow out of the block beside that of the air"
      input Real T(unit="K") "Temperature of the block, above the room";
      output Real Q(unit="W") "Heat flow, positive out of the block";
    end PartialLoss;

    model Direct "At once"
      extends PartialActuator;
    equation
      y = u;
    end Direct;

    model NoLoss "Nothing"
      extends PartialLoss;
    equation
      Q = 0;
    end NoLoss;
  end Slots;

  model Block "The heater as designed"
    parameter Real C_p(unit="J/K", min=25, max=250, nominal=75) = 75 "Heat capacity of the plate";
    parameter Real C_b(unit="J/K", min=50, max=500, nominal=200) = 200 "Heat capacity of the block";
    parameter Real G(unit="W/K", min=1, max=50, nominal=8) = 8 "Conductance between plate and block";
    parameter Real h(unit="W/K", min=0.1, max=10, nominal=1.5) = 1.5 "Conductance between block and air";
    input Real P(unit="W", start=0) "Power wanted";
    output Real T_p(unit="K", start=0, fixed=true) "Temperature of the plate, above the room";
    output Real T_b(unit="K", start=0, fixed=true) "Temperature of the block, above the room";
    Real Q(unit="W") "Heat flow from plate to block";
    replaceable Slots.Direct actuator constrainedby Slots.PartialActuator "What turns the command into power";
    replaceable Slots.NoLoss loss constrainedby Slots.PartialLoss "Heat losses of the block";
  equation
    actuator.u = P;
    loss.T = T_b;
    Q = G*(T_p - T_b);
    C_p*der(T_p) = actuator.y - Q;
    C_b*der(T_b) = Q - h*T_b - loss.Q;
  end Block;

  package Effects "What the heater may have beyond its design"
    model DeadTime "Dead time of the power controller, as a Pade approximation of order 3"
      extends Slots.PartialActuator;
      parameter Real tau(unit="s", min=0, max=60, nominal=5) = 0 "Dead time, 0 = off";
      constant Real tau_min(unit="s") = 0.05 "Shorter dead times are held at this one";
      Real T(unit="s") "Dead time in force";
      Real z1(start=0, fixed=true) "First state; equals the power wanted at rest";
      Real z2(start=0, fixed=true) "Second state";
      Real z3(start=0, fixed=true) "Third state";
    equation
      T = sqrt(tau^2 + tau_min^2);
      der(z1) = z2/T;
      der(z2) = z3/T;
      der(z3) = (120*(u - z1) - 60*z2 - 12*z3)/T;
      y = 2*z1 + z3/5 - u;
      annotation(__HydraulicTestBench(effect="heater.deadtime", slot="actuator"));
    end DeadTime;

    model Saturation "Power that the controller cannot exceed"
      extends Slots.PartialActuator;
      parameter Real k(unit="1/W", min=0, max=0.01, nominal=1e-3) = 0 "Loss of gain per power, 0 = off";
    equation
      y = u/(1 + k*abs(u));
      annotation(__HydraulicTestBench(effect="heater.saturation", slot="actuator"));
    end Saturation;

    model Radiation "Radiation of the block"
      extends Slots.PartialLoss;
      parameter Real s(unit="W/K4", min=0, max=1e-7, nominal=1e-9) = 0 "Emission over the whole surface, 0 = off";
      constant Real T_room(unit="K") = 293.15 "Temperature of the room";
    equation
      Q = s*((T + T_room)^4 - T_room^4);
      annotation(__HydraulicTestBench(effect="heater.radiation", slot="loss"));
    end Radiation;
  end Effects;
end Heater;
