package Drive "Positioning drive: motor, spindle, carriage, cascaded control"
  package Slots "What may be missing, and where"
    partial model PartialForce "A force on the carriage beside that of the spindle"
      input Real x(unit="m") "Position of the carriage";
      input Real v(unit="m/s") "Its velocity";
      output Real f(unit="N") "Force, positive towards positive x";
    end PartialForce;

    partial model PartialTorque "A torque on the shaft beside those of motor and spindle"
      input Real phi(unit="rad") "Angle of the shaft";
      input Real w(unit="rad/s") "Its velocity";
      output Real tau(unit="N.m") "Torque, positive towards positive phi";
    end PartialTorque;

    model NoForce "Nothing"
      extends PartialForce;
    equation
      f = 0;
    end NoForce;

    model NoTorque "Nothing"
      extends PartialTorque;
    equation
      tau = 0;
    end NoTorque;
  end Slots;

  model Axis "The drive as designed"
    parameter Real J(unit="kg.m2", min=2e-4, max=2e-3, nominal=6e-4) = 6e-4 "Inertia of motor and spindle";
    parameter Real m(unit="kg", min=20, max=60, nominal=40) = 40 "Mass of the carriage";
    parameter Real c(unit="N/m", min=2e6, max=5e7, nominal=1e7) = 1e7 "Stiffness of spindle and nut";
    parameter Real d(unit="N.s/m", min=0, max=1e4, nominal=2e3) = 2e3 "Damping of the guideway";
    parameter Real K_t(unit="N.m/A") = 0.5 "Torque constant of the motor";
    parameter Real h(unit="m/rad") = 0.01/6.283185307179586 "Lead of the spindle";
    parameter Real T_d(unit="s") = 2e-3 "Damping of spindle and nut over their stiffness";
    parameter Real K_v(unit="1/s") = 40 "Gain of the position controller, P";
    parameter Real K_p(unit="A.s/rad") = 0.5 "Gain of the velocity controller, PI";
    parameter Real T_n(unit="s") = 0.02 "Its reset time";
    input Real x_ref(unit="m", start=0) "Position wanted";
    output Real x(unit="m", start=0, fixed=true) "Position of the carriage, from its scale";
    output Real i(unit="A") "Motor current";
    Real v(unit="m/s", start=0, fixed=true) "Velocity of the carriage";
    Real phi(unit="rad", start=0, fixed=true) "Angle of the shaft";
    Real w(unit="rad/s", start=0, fixed=true) "Its velocity";
    Real w_ref(unit="rad/s") "Velocity wanted";
    Real e(unit="rad", start=0, fixed=true) "Integral of the velocity error";
    Real f(unit="N") "Force of the spindle on the carriage";
    replaceable Slots.NoForce guideway constrainedby Slots.PartialForce "Forces on the carriage";
    replaceable Slots.NoTorque shaft constrainedby Slots.PartialTorque "Torques on the shaft";
  equation
    w_ref = K_v*(x_ref - x)/h;
    der(e) = w_ref - w;
    i = K_p*(w_ref - w + e/T_n);
    f = c*(h*phi - x + T_d*(h*w - v));
    der(phi) = w;
    J*der(w) = K_t*i - h*f + shaft.tau;
    der(x) = v;
    m*der(v) = f - d*v + guideway.f;
    guideway.x = x;
    guideway.v = v;
    shaft.phi = phi;
    shaft.w = w;
  end Axis;

  package Effects "What the drive may have beyond its design"
    model GuidewayFriction "Dry friction of the guideway"
      extends Slots.PartialForce;
      parameter Real F_c(unit="N", min=0, max=500, nominal=50) = 0 "Friction force, 0 = off";
    equation
      f = -F_c*tanh(v/1e-3);
      annotation(__HydraulicTestBench(effect="axis.friction", slot="guideway"));
    end GuidewayFriction;

    model Incline "Weight of the carriage on an axis that is not level"
      extends Slots.PartialForce;
      parameter Real F_g(unit="N", min=-400, max=400, nominal=50) = 0 "Weight along the axis, 0 = off";
    equation
      f = -F_g;
      annotation(__HydraulicTestBench(effect="axis.incline", slot="guideway"));
    end Incline;

    model Cogging "Torque between the motor's magnets and its iron"
      extends Slots.PartialTorque;
      parameter Real T_c(unit="N.m", min=-1, max=1, nominal=0.1) = 0 "Amplitude, 0 = off";
      constant Integer periods = 12 "Periods in a turn";
    equation
      tau = T_c*sin(periods*phi);
      annotation(__HydraulicTestBench(effect="axis.cogging", slot="shaft"));
    end Cogging;

    model Forces "Two forces on the carriage at once"
      extends Slots.PartialForce;
      replaceable Slots.NoForce first constrainedby Slots.PartialForce;
      replaceable Slots.NoForce second constrainedby Slots.PartialForce;
    equation
      first.x = x;
      first.v = v;
      second.x = x;
      second.v = v;
      f = first.f + second.f;
      annotation(__HydraulicTestBench(pair="guideway"));
    end Forces;
  end Effects;
end Drive;
