package HydraulicActuator "A valve fills a chamber that moves an arm, and what may act on them besides"
  partial model PartialOpening "The valve's opening on its way: s in, y out"
    input Real s(unit="1") "Opening as the base model has it";
    output Real y(unit="1") "Opening that the flow sees";
  end PartialOpening;

  model NoOpening "The opening as it is"
    extends PartialOpening;
  equation
    y = s;
  end NoOpening;

  partial model PartialFlow "Flow into the chamber besides that of the base model"
    input Real u(unit="1") "Opening";
    input Real p(unit="1") "Pressure";
    input Real v(unit="1/s") "Velocity of the arm";
    output Real q(unit="1/s") "Flow over the chamber's capacity, positive inwards";
  end PartialFlow;

  model NoFlow "Nothing"
    extends PartialFlow;
  equation
    q = 0;
  end NoFlow;

  partial model PartialArm "Forces on the arm besides pressure, damping and stiffness"
    input Real x(unit="1") "Position";
    input Real v(unit="1/s") "Velocity";
    output Real f(unit="1/s2") "Acceleration to add";
  end PartialArm;

  model NoArm "Nothing"
    extends PartialArm;
  equation
    f = 0;
  end NoArm;

  model Actuator "Linear valve, chamber with leakage, arm with damping and stiffness"
    parameter Real k_q(unit="1/s", min=-5, max=0, nominal=0.8) = -0.8 "Flow per opening";
    parameter Real a(unit="1/s", min=0, max=3, nominal=0.05) = 0.05 "Leakage";
    parameter Real c_b(unit="1", min=0, max=3, nominal=0.05) = 0.05 "Flow per velocity of the arm";
    parameter Real d(unit="1/s", min=0, max=3, nominal=0.1) = 0.1 "Damping of the arm";
    parameter Real w2(unit="1/s2", min=0, max=2, nominal=0.01) = 0.001 "Stiffness of the arm";
    parameter Real u_n(unit="1", min=-0.3, max=0.3, nominal=0.05) = 0 "Opening at which nothing flows";
    input Real u(unit="1", start=0) "Opening of the valve, scaled";
    output Real p(unit="1", start=0, fixed=true) "Pressure, scaled";
    Real v(unit="1/s", start=0, fixed=true) "Velocity of the arm";
    Real x(unit="1", start=0, fixed=true) "Its position";
    replaceable NoOpening opening constrainedby PartialOpening "Opening of the valve";
    replaceable NoFlow chamber constrainedby PartialFlow "Flow into the chamber";
    replaceable NoArm arm constrainedby PartialArm "Forces on the arm";
  equation
    opening.s = u - u_n;
    der(p) = k_q*opening.y - a*p - c_b*v + chamber.q;
    der(v) = p - d*v - w2*x + arm.f;
    der(x) = v;
    chamber.u = opening.y;
    chamber.p = p;
    chamber.v = v;
    arm.x = x;
    arm.v = v;
  end Actuator;

  package Effects "What may be missing"
    model Direction "Gain that differs with the direction of the valve"
      extends PartialOpening;
      parameter Real g(unit="1", min=-0.95, max=0.95, nominal=0.1) = 0 "Half of the difference, 0 = off";
    equation
      y = s + g*abs(s);
      annotation(__HydraulicTestBench(effect="valve.direction", slot="opening"));
    end Direction;

    model Deadband "Overlap of the valve's edges"
      extends PartialOpening;
      parameter Real u_0(unit="1", min=0, max=0.5, nominal=0.05) = 0 "Half of its width, 0 = off";
    equation
      y = noEvent(if s > 0 then max(s - u_0, 0) else min(s + u_0, 0));
      annotation(__HydraulicTestBench(effect="valve.overlap", slot="opening"));
    end Deadband;

    model Curved "Gain that changes with the opening"
      extends PartialOpening;
      parameter Real p_1(unit="1", min=-0.9, max=3, nominal=0.3) = 0 "Power beyond 1, 0 = off";
    equation
      y = s*(s^2 + 1e-6)^(p_1/2);
      annotation(__HydraulicTestBench(effect="valve.curved", slot="opening"));
    end Curved;

    model Clipping "Largest opening"
      extends PartialOpening;
      parameter Real inverse_u_max(unit="1", min=0, max=10, nominal=1) = 0 "One over it, 0 = off"
        annotation(__HydraulicTestBench(inverse="u_max", limits="s"));
    equation
      y = s/max(1, abs(s)*inverse_u_max);
      annotation(__HydraulicTestBench(effect="valve.clipping", slot="opening"));
    end Clipping;

    model Lag "Time that the valve takes"
      extends PartialOpening(y(start=0, fixed=true));
      parameter Real T(unit="s", min=0, max=20, nominal=1) = 0 "Time constant, 0 = off";
    equation
      der(y) = (s - y)/max(T, 0.05);
      annotation(__HydraulicTestBench(effect="valve.lag", slot="opening", bypass=true));
    end Lag;

    model OpeningLeakage "Leakage that grows with the opening"
      extends PartialFlow;
      parameter Real a_u(unit="1/s", min=0, max=5, nominal=0.1) = 0 "Leakage per opening, 0 = off";
    equation
      q = -a_u*abs(u)*p;
      annotation(__HydraulicTestBench(effect="chamber.opening_leakage", slot="chamber"));
    end OpeningLeakage;

    model PressureFlow "Flow that falls with the pressure across the valve"
      extends PartialFlow;
      parameter Real k_p(unit="1/s", min=-1, max=1, nominal=0.05) = 0 "Product of opening and pressure, 0 = off";
    equation
      q = k_p*u*p;
      annotation(__HydraulicTestBench(effect="chamber.pressure_flow", slot="chamber"));
    end PressureFlow;

    model TurbulentLeakage "Leakage with the square of the pressure"
      extends PartialFlow;
      parameter Real a_2(unit="1/s", min=0, max=2, nominal=0.02) = 0 "Leakage, 0 = off";
    equation
      q = -a_2*p*abs(p);
      annotation(__HydraulicTestBench(effect="chamber.turbulent_leakage", slot="chamber"));
    end TurbulentLeakage;

    model Friction "Dry friction of the arm"
      extends PartialArm;
      parameter Real f_c(unit="1/s2", min=0, max=5, nominal=0.1) = 0 "Deceleration, 0 = off";
    equation
      f = -f_c*tanh(v/0.05);
      annotation(__HydraulicTestBench(effect="arm.friction", slot="arm"));
    end Friction;

    model Hardening "Spring that grows stiffer"
      extends PartialArm;
      parameter Real k_3(unit="1/s2", min=0, max=1, nominal=1e-4) = 0 "Cubic stiffness, 0 = off";
    equation
      f = -k_3*x^3;
      annotation(__HydraulicTestBench(effect="arm.hardening", slot="arm"));
    end Hardening;

    model Drag "Damping with the square of the velocity"
      extends PartialArm;
      parameter Real d_2(unit="1", min=0, max=2, nominal=0.02) = 0 "Damping, 0 = off";
    equation
      f = -d_2*v*abs(v);
      annotation(__HydraulicTestBench(effect="arm.drag", slot="arm"));
    end Drag;

    model Openings "Two changes of the opening, one behind the other"
      extends PartialOpening;
      replaceable NoOpening first constrainedby PartialOpening;
      replaceable NoOpening second constrainedby PartialOpening;
    equation
      first.s = s;
      second.s = first.y;
      y = second.y;
      annotation(__HydraulicTestBench(pair="opening"));
    end Openings;

    model Flows "Two flows at once"
      extends PartialFlow;
      replaceable NoFlow first constrainedby PartialFlow;
      replaceable NoFlow second constrainedby PartialFlow;
    equation
      first.u = u;
      first.p = p;
      first.v = v;
      second.u = u;
      second.p = p;
      second.v = v;
      q = first.q + second.q;
      annotation(__HydraulicTestBench(pair="chamber"));
    end Flows;

    model Forces "Two forces at once"
      extends PartialArm;
      replaceable NoArm first constrainedby PartialArm;
      replaceable NoArm second constrainedby PartialArm;
    equation
      first.x = x;
      first.v = v;
      second.x = x;
      second.v = v;
      f = first.f + second.f;
      annotation(__HydraulicTestBench(pair="arm"));
    end Forces;
  end Effects;
end HydraulicActuator;
