// A class for each slot of the pump, as short as it can be; its first parameter is the strength, 0 = off.
// Used by test_slots.py.

package SlotFillings
  model PistonCoulomb
    extends HydraulicTestBench.Interfaces.PartialPistonForce;
    parameter Real F_c = 0;
  equation
    f = -F_c*tanh(v/1e-3);
  end PistonCoulomb;

  model SpringPreload
    extends HydraulicTestBench.Interfaces.PartialPistonForce;
    parameter Real F_0 = 0;
  equation
    f = -F_0*tanh(x/0.2e-3);
  end SpringPreload;

  model TwoForces
    extends HydraulicTestBench.Interfaces.PartialPistonForce;
    parameter Real F = 0;
    PistonCoulomb friction(F_c=F);
    SpringPreload preload(F_0=F);
  equation
    friction.x = x;
    friction.v = v;
    preload.x = x;
    preload.v = v;
    f = friction.f + preload.f;
  end TwoForces;

  model LinkageBacklash
    extends HydraulicTestBench.Interfaces.PartialSignalWithRate(y(start=0, fixed=true));
    parameter Real d = 0;
  equation
    y_t = (max(s - d - y, 0) + min(s + d - y, 0))/1e-4;
    der(y) = y_t;
  end LinkageBacklash;

  model ValveDeadband
    extends HydraulicTestBench.Interfaces.PartialSignal;
    parameter Real u_0 = 0;
  equation
    y = noEvent(if s > 0 then max(s - u_0, 0) else min(s + u_0, 0));
  end ValveDeadband;

  model ValveOffset
    extends HydraulicTestBench.Interfaces.PartialSignal;
    parameter Real u_n = 0;
  equation
    y = s + u_n;
  end ValveOffset;

  model ValveRateLimit
    extends HydraulicTestBench.Interfaces.PartialSpool(u(start=0, fixed=true), u_t(start=0, fixed=true));
    parameter Real inverse_r_max = 0;
  protected
    Real free "Acceleration without limit";
  equation
    free = omega_v^2*(u_ref - u) - 2*zeta_v*omega_v*u_t;
    u_tt = if u_t*inverse_r_max > 1 and free > 0 or u_t*inverse_r_max < -1 and free < 0 then 0 else free;
    der(u) = u_t;
    der(u_t) = u_tt;
  end ValveRateLimit;

  model CommandHysteresis
    extends HydraulicTestBench.Interfaces.PartialSignal(y(start=0, fixed=true));
    parameter Real h = 0;
  equation
    der(y) = (max(s - h - y, 0) + min(s + h - y, 0))/1e-5;
  end CommandHysteresis;

  model EntrainedAir
    extends HydraulicTestBench.Interfaces.PartialCompressibility;
    parameter Real eps = 0;
    constant Real n = 1.4;
    constant Real p_0 = 1.013e5;
  equation
    kappa1 = eps*(p_0/max(p1 + p_0, 1e3))^(1/n)/(n*max(p1 + p_0, 1e3));
    kappa2 = eps*(p_0/max(p2 + p_0, 1e3))^(1/n)/(n*max(p2 + p_0, 1e3));
  end EntrainedAir;

  model SupplyDroop
    extends HydraulicTestBench.Interfaces.PartialSupply(dp(start=0, fixed=true));
    parameter Real R = 0;
    parameter Real T = 0.02;
  equation
    T*der(dp) = R*Q - dp;
  end SupplyDroop;

  model LaminarLeakage
    extends HydraulicTestBench.Interfaces.PartialTwoPort;
    parameter Real C_l = 0;
  equation
    q = C_l*dp;
  end LaminarLeakage;

  model LeakageToTank
    extends HydraulicTestBench.Interfaces.PartialExternalLeakage;
    parameter Real C_e = 0;
  equation
    q1 = C_e*p1;
    q2 = C_e*p2;
  end LeakageToTank;

  model SensorLag
    extends HydraulicTestBench.Interfaces.PartialSignalWithRate(y(start=0, fixed=true));
    parameter Real T_f = 0;
  equation
    y_t = (s - y)/max(T_f, 1e-5);
    der(y) = y_t;
  end SensorLag;

  model ErrorDeadZone
    extends HydraulicTestBench.Interfaces.PartialSignalWithRate;
    parameter Real e_0 = 0;
  equation
    y = noEvent(if s > 0 then max(s - e_0, 0) else min(s + e_0, 0));
    y_t = noEvent(if abs(s) > e_0 then s_t else 0);
  end ErrorDeadZone;
end SlotFillings;
