package Axis "A positioning drive: amplifier, motor, carriage, proportional controller"
  partial model PartialForce "A force on the carriage besides that of the motor"
    input Real x(unit="m") "Position";
    input Real v(unit="m/s") "Velocity";
    output Real f(unit="N") "Force, positive towards positive x";
  end PartialForce;

  partial model PartialAmplifier "What the amplifier makes of its command"
    input Real u(unit="V") "Command";
    output Real w(unit="V") "What reaches the motor";
  end PartialAmplifier;

  model NoForce "Nothing"
    extends PartialForce;
  equation
    f = 0;
  end NoForce;

  model Ideal "The command itself"
    extends PartialAmplifier;
  equation
    w = u;
  end Ideal;

  model Friction "Dry friction of the guideway"
    extends PartialForce;
    parameter Real F_c(unit="N", min=0, max=50, nominal=5) = 0 "Friction force, 0 = off";
  equation
    f = -F_c*tanh(v/0.005);
    annotation(__HydraulicTestBench(effect="axis.friction", slot="guideway"));
  end Friction;

  model Incline "Weight on an axis that is not level"
    extends PartialForce;
    parameter Real F_g(unit="N", min=-50, max=50, nominal=5) = 0 "Weight along the axis, 0 = off";
  equation
    f = -F_g;
    annotation(__HydraulicTestBench(effect="axis.incline", slot="guideway"));
  end Incline;

  model DeadBand "Small commands do not reach the motor"
    extends PartialAmplifier;
    parameter Real u_0(unit="V", min=0, max=2, nominal=0.2) = 0 "Half width, 0 = off";
  equation
    w = u + noEvent(abs(u - u_0) - abs(u + u_0))/2;
    annotation(__HydraulicTestBench(effect="axis.dead_band", slot="amplifier"));
  end DeadBand;

  model Offset "The amplifier is off zero"
    extends PartialAmplifier;
    parameter Real u_n(unit="V", min=-2, max=2, nominal=0.2) = 0 "Offset, 0 = off";
  equation
    w = u + u_n;
    annotation(__HydraulicTestBench(effect="axis.offset", slot="amplifier"));
  end Offset;

  model Design "The drive as designed"
    parameter Real m(unit="kg") = 10 "Mass of the carriage, weighed";
    parameter Real d(unit="N.s/m", min=0, max=400, nominal=100) = 100 "Damping of the guideway";
    parameter Real K(unit="N/V", min=5, max=100, nominal=20) = 20 "Force of the motor over its voltage";
    parameter Real T(unit="s", min=1e-3, max=0.1, nominal=0.02) = 0.02 "Lag of the motor";
    parameter Real K_v(unit="V/m") = 50 "Gain of the controller";
    input Real x_ref(unit="m", start=0) "Position wanted";
    output Real x(unit="m", start=0, fixed=true) "Position";
    output Real i(unit="V", start=0, fixed=true) "Voltage at the motor";
    Real v(unit="m/s", start=0, fixed=true) "Velocity";
    replaceable NoForce guideway constrainedby PartialForce;
    replaceable Ideal amplifier constrainedby PartialAmplifier;
  equation
    guideway.x = x;
    guideway.v = v;
    amplifier.u = K_v*(x_ref - x);
    T*der(i) = amplifier.w - i;
    der(x) = v;
    m*der(v) = K*i - d*v + guideway.f;
  end Design;
end Axis;
